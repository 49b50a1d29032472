"""What a notebook shows of theories, models, answers, rules, games, turns, …"""

from __future__ import annotations

import re
import warnings
from dataclasses import dataclass, replace
from html import unescape
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace

import pytest

import ttr
from rich_values import HOSTILE, check_html, check_latex
from ttr import Basic, Ind, Model, Pred, Theory, record, rectype, subtype, this
from ttr.dialogues.dialogue import play as play_all
from ttr.dialogues.logs import read_logs, replay, write_log
from ttr.dialogues.stories import Setting
from ttr.dialogues.stories import play as play_story
from ttr.dialogues.stories.story_reader import stories_of_text
from ttr.display.room import room_for
from ttr.errors import IllFormedError
from ttr.showing import Below, Figure, Fold, NotebookValue, Part, Value
from ttr.testing import Coverage, Property, Suite
from ttr.types.records import find_differences
from ttr.updates import NBest, rule
from ttr.updates.games import Game

KENNEL = Theory.parse(
    r"""
    basic Ind, Loc
    pred dog(Ind), hug(Ind, Ind), puppy(Ind), cat(Ind)
    object fido, sam : Ind
    puppy(x) <: dog(x)
    dog(x) <: ~cat(x)
    Dog := [x : Ind, c : dog(x)]
    Hugging := [a : Dog, b : Dog, e : hug(a.x, b.x)]
    check [x : Ind, c : puppy(x)] <= Dog
    Board := [spkr : Ind, addr : Ind, heard : list(Ind)]
    rule turn(s : Board) "Who was spoken to speaks." of floor
        where [a = s.addr : Ind] := [spkr = a : Ind, addr = s.spkr : Ind]
    rule note(s : Board, e : Ind) "What was heard is kept."
        := [heard = s.heard + [e] : list(Ind)]
    strategy both := seq(note, turn)
    game talk({spkr = fido, addr = sam, heard = []} : Board) := both
    """
)
MODEL = (
    Model(KENNEL).given("s1", KENNEL.dog("fido")).given("s2", KENNEL.dog("sam"), 0.7)
)
GAME = KENNEL.games["talk"]
TURN = GAME.take(GAME.begin(), "fido")
PERHAPS = GAME.take(GAME.begin(), NBest((("fido", 0.6), ("sam", 0.3))))
JUDGED = MODEL.judge(record(x="fido", c="s2"), KENNEL.Dog)
REFUTED = subtype(KENNEL.Dog, KENNEL.Hugging, KENNEL)

WRONG = Theory.parse(
    """
    basic Ind
    pred dog(Ind)
    object fido : Ind
    check {x = fido} : [x : Ind, c : dog(x)]
    check [x : Ind] <= [y : Ind]
    rule rest(s : [x : Ind]) := [y = fido : Ind]
    game idle({x = fido} : [x : Ind]) := rest
    """
)

NEVER = Property("P99", "never", "Nobody says <b>.", lambda *_: iter([(1, "<b>")]))


def _dialogue_values() -> dict[str, NotebookValue]:
    """Stories, logs and reports about a game."""
    setting = Setting.of(GAME, KENNEL, "kennel.ttr talk")
    text = "--- <b>hello</b>\n@ game kennel.ttr talk\nU> fido\nS>\n{}"
    good, bad = (
        stories_of_text(text.format(more), Path("hello.dlg"))[0]
        for more in ("= s : [addr : Ind]", "= s : [addr = sam : Ind]\nS> Woof.")
    )
    with TemporaryDirectory() as folder:
        file = Path(folder, "talk.jsonl")
        dialogue = play_all(GAME, ["fido", "sam"])
        write_log(file, [replace(dialogue, place=setting, title="<b>")])
        (log,) = read_logs(file)
    moved = replace(log, entries=(replace(log.entries[0], state="{}"),))
    failing = Suite(GAME, properties=(NEVER,), examples=2).run()
    return {
        "story": good,
        "story as played": play_story(good, setting),
        "story that differs": play_story(bad, setting),
        "mismatch": play_story(bad, setting).mismatch,
        "log": log,
        "log replayed": replay(log, setting),
        "log that differs": replay(moved, setting),
        "properties": Suite(GAME, examples=2).run(),
        "properties that break": failing,
        "coverage": failing.coverage,
    }


VALUES = {
    "theory": KENNEL,
    "empty theory": Theory(),
    "model": MODEL,
    "empty model": Model(),
    "judgement": JUDGED,
    "derivation": JUDGED.why,
    "yes": subtype(KENNEL.Hugging, rectype(a=KENNEL.Dog), KENNEL),
    "no": REFUTED,
    "rule": KENNEL.rules["turn"],
    "rule with an event": KENNEL.rules["note"],
    "game": GAME,
    "turn": TURN,
    "turn with alternatives": PERHAPS,
    "run": TURN.run,
    "step": TURN.trace[0],
    **_dialogue_values(),
    "report": ttr.check(KENNEL),
    "report of failures": ttr.check(WRONG),
    "several": ttr.show([KENNEL.Dog, "fido"], {"why": JUDGED.why, "game": GAME}),
}


every_value = pytest.mark.parametrize("value", VALUES.values(), ids=VALUES.keys())


@every_value
def test_html_is_whole_escaped_and_needs_nothing_else(value) -> None:
    check_html(value._repr_html_())
    assert value._repr_html_() == ttr.html(value)


@every_value
def test_latex_is_what_all_its_readers_know(value) -> None:
    check_latex(ttr.latex(value))
    assert value._repr_latex_() == f"$\\displaystyle {ttr.latex(value)}$"


def plain(value: NotebookValue) -> str:
    """The words of what a notebook shows, with blanks between cells and lines."""
    shown = re.sub("<style>.*?</style>", "", value._repr_html_(), flags=re.DOTALL)
    apart = re.sub("</(?:td|th|div|summary)>", " ", shown)
    return " ".join(unescape(re.sub("<[^>]*>", "", apart)).split())


def test_a_theory_shows_all_that_is_in_it() -> None:
    shown = plain(KENNEL)
    for part in (
        "basic types (2)",
        "hug(Ind, Ind)",
        "dog(x) <: ~cat(x)",
        "Who was spoken to speaks.",
        "seq(note, turn)",
        "check [x : Ind, c : puppy(x)] <= Dog",
    ):
        assert part in shown
    assert "a:Dog" in shown.replace(" ", "")  # by its name


def test_a_report_of_checks_shows_what_failed_and_where() -> None:
    shown = plain(VALUES["report of failures"])
    for part in (
        "2 of 2 checks failed, 1 fault in 1 rule",
        "failed: check [x : Ind] <= [y : Ind] expected yes, found no",
        "there is no c",
        "the rule rest writes y, but a state has no y",
        "rule rest(s : [x : Ind]) := [y = fido : Ind]",
    ):
        assert part in shown
    assert plain(VALUES["report"]) == "1 check holds, no fault in 2 rules"
    assert "turn" in ttr.html(ttr.show(GAME.play(["fido", "sam"])))


def test_a_refutation_shows_its_counterexample() -> None:
    assert "counterexample:" in plain(REFUTED)
    assert str(REFUTED.counter.sit["x"]) in plain(REFUTED)
    assert "counterexample" not in plain(VALUES["yes"])


def test_a_rule_is_its_condition_above_its_effect() -> None:
    shown = plain(KENNEL.rules["turn"]).replace(" ", "")
    assert "pres:" in shown
    assert "where:[a=s.addr:Ind]" in shown
    assert "effect:[addr=s.spkr:Ind,spkr=a:Ind]" in shown


def test_a_rule_in_python_says_so() -> None:
    @rule(when=KENNEL.Board)
    def listen(s, model):
        return None

    assert "listen(s, model) in Python" in plain(listen)


def test_a_turn_shows_what_each_rule_changed() -> None:
    shown = plain(TURN)
    assert "with a = sam" in shown
    assert "heard + fido" in shown
    assert "spkr fido sam" in shown


def test_a_story_shows_its_lines_and_where_it_differs() -> None:
    assert "<b>hello</b>" in plain(VALUES["story"])
    assert "✓" not in plain(VALUES["story as played"])  # the style has the sign
    assert "played as it is written" in plain(VALUES["story as played"])
    differs = plain(VALUES["story that differs"])
    assert "differs from hello.dlg:5 on" in differs
    assert "expected: [addr = sam : Ind]" in differs
    assert "replayed as it was" in plain(VALUES["log replayed"])
    assert "differs at" in plain(VALUES["log that differs"])


def test_a_report_shows_what_breaks_and_what_was_covered() -> None:
    broken = plain(VALUES["properties that break"])
    assert "Nobody says <b>." in broken
    assert "a dialogue in talk" in broken
    assert "never applied" in plain(Coverage(GAME))


def test_a_turn_shows_alternatives_with_their_probabilities() -> None:
    assert "fido 0.6" in plain(PERHAPS)


def test_differences_are_lines_and_values() -> None:
    before, after = record(x=1, y=["a"], z=0), record(x=2, y=["a", "b"], w=0)
    found = list(find_differences(before, after))
    assert list(map(str, found)) == [
        "w: nothing → 0",
        "x: 1 → 2",
        "y: + b",
        "z: 0 → nothing",
    ]
    assert [it.after for it in found if it.listed] == ["b"]


# --- hostile and large ----------------------------------------------------------------


def test_hostile_names_do_nothing() -> None:
    told = record(a=HOSTILE, b=[HOSTILE])
    board = rectype(a=Basic("Ind") @ HOSTILE)

    @rule(when=board, on=Ind, kind=HOSTILE)
    def note(s, e):
        return None

    hostile_rule = replace(note, doc=HOSTILE, name=HOSTILE)
    theory = Theory(source=HOSTILE, definitions={HOSTILE: board})
    model = Model().given(HOSTILE, Ind)
    game = Game(HOSTILE, rectype(a=Ind), {"a": HOSTILE}, note, model)
    values = [told, hostile_rule, theory, model, game, ttr.show({HOSTILE: told})]
    values.append(model.judge(HOSTILE, Ind).why)
    for value in values:
        check_html(value._repr_html_())
        assert "script&gt;" in value._repr_html_()
        check_latex(ttr.latex(value))


def test_a_large_value_is_drawn_in_part() -> None:
    preds = {f"p{i}": Pred(f"p{i}", Ind) for i in range(1000)}
    theory = Theory(
        predicates=preds,
        objects=frozenset(f"o{i}" for i in range(1000)),
        definitions={f"T{k}": rectype(x=Ind, c=p(this.x)) for k, p in preds.items()},
    )
    check_html(theory._repr_html_())
    check_latex(ttr.latex(theory))
    assert "definitions (1,000)" in plain(theory)
    assert "… 940 more" in plain(theory)
    things = record(seen=[record(x=f"x{i}", at=[i, i]) for i in range(10_000)])
    check_html(things._repr_html_())
    assert "… 9,960 more" in plain(things)
    fifty = record(seen=[f"x{i}" for i in range(50)])
    assert "x49" not in fifty._repr_html_()
    assert "x49" in ttr.html(fifty)  # who asks for it has all of it


def test_only_what_is_shown_is_laid_out(monkeypatch) -> None:
    from ttr.display import layout

    laid_out = []
    monkeypatch.setattr(layout, "spend", lambda *_: laid_out.append(1))
    wide = record({f"x{i}": record(a=1, b=[2] * 100) for i in range(10_000)})
    wide._repr_html_()
    assert len(laid_out) < 10_000


def test_what_cannot_be_drawn_is_a_line_and_no_error() -> None:
    T = Ind
    for _ in range(3000):
        T = ttr.ListOf(T)
    check_html(T._repr_html_())
    assert "deeper than can be followed" in T._repr_html_()
    assert T._repr_latex_() is None


def test_a_long_text_is_cut() -> None:
    check_html(record(a="x" * 1_000_000)._repr_html_())
    assert "more letters" in plain(record(a="x" * 1_000_000))


def test_a_large_state_folds_and_what_changed_stays_open() -> None:
    part = record({f"f{i}": [f"a{i}"] * 3 for i in range(20)})
    state = record(shared=part, private=part)
    assert state._repr_html_().count('<details class="ttr-folded">') == 2
    assert record(a=1, b=[2])._repr_html_().count('<details class="ttr-folded">') == 0
    later = ttr.replace(state, {"shared.f1": []})

    @dataclass(frozen=True)
    class Changed(NotebookValue):
        def _shown_as_(self) -> Part:
            return Value(later, before=state)

    drawn = Changed()._repr_html_()
    assert drawn.count('<details class="ttr-folded">') == 1
    assert drawn.count('class="ttr-changed"') == 1


def test_a_large_claim_folds_and_is_still_there() -> None:
    T = rectype(**{f"label_{n}": Ind for n in range(30)})
    made = record(**{f"label_{n}": "fido" for n in range(30)})
    shown = ttr.html(Model().given("fido", Ind).judge(made, T).why)
    assert "{30 fields}" in shown
    assert "[30 fields]" in shown
    assert shown.count("label_29") == 3, "in the object, in the type, in its own step"
    assert "ttr-folded" not in ttr.html(JUDGED.why).partition("</style>")[2]


def test_rooms_inside_a_room_share_it() -> None:
    from ttr.display.room import take_room

    with room_for(3):
        with room_for(2):
            assert [take_room() for _ in range(3)] == [True, True, False]
        assert not take_room()


# --- parts ----------------------------------------------------------------------------


@dataclass(frozen=True)
class Pictured(NotebookValue):
    def _shown_as_(self) -> Part:
        body = Figure(b"png", "image/png", HOSTILE, 40)
        return Below((Fold(HOSTILE, body), Fold("again", body)))


def test_a_picture_is_in_the_html_and_has_no_latex() -> None:
    check_html(Pictured()._repr_html_())
    assert 'src="data:image/png;base64,cG5n"' in Pictured()._repr_html_()
    assert Pictured()._repr_latex_() is None
    with pytest.raises(IllFormedError, match="a picture has no LaTeX, found Pictured"):
        ttr.latex(Pictured())


def test_latex_leaves_pictures_out(monkeypatch) -> None:
    figure = Figure(b"png", "image/png", "a cup", 40)
    shown = Below((Value(Ind), Fold("seen", figure)))
    monkeypatch.setattr(Pictured, "_shown_as_", lambda _: shown)
    assert ttr.latex(Pictured()) == ttr.latex(Ind)


# --- several values, and names --------------------------------------------------------


def test_several_values_print_as_text() -> None:
    assert str(ttr.show(Ind, {"dog": KENNEL.Dog})).splitlines() == [
        "Ind",
        "dog:",
        "⎡x : Ind   ⎤",
        "⎣c : dog(x)⎦",
    ]
    assert "Dog" in repr(ttr.show([KENNEL.Hugging], unfold=1, theory=KENNEL))
    assert repr(ttr.show(REFUTED)) == str(REFUTED)
    with pytest.raises(IllFormedError, match="derivations are drawn, found function"):
        ttr.show([rectype])


@pytest.mark.parametrize("value", [KENNEL, record(x=1, bg=record(y=2)), Theory()])
def test_each_name_that_is_offered_can_be_got(value) -> None:
    for name in dir(value):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)  # of former names
            assert getattr(value, name, value) is not value
    for key in value._ipython_key_completions_():
        assert value[key] is not None


def test_names_of_a_theory_and_labels_of_a_record_are_offered() -> None:
    assert {"Dog", "Ind", "dog", "rules", "parse"} <= {*dir(KENNEL)}
    assert "Dog" in KENNEL._ipython_key_completions_()
    assert {"x", "bg"} <= {*dir(record(x=1, bg=record(y=2)))}


@pytest.mark.deep
def test_ipython_completes_keys_and_names() -> None:
    completer = pytest.importorskip("IPython.core.completer")
    place = {"t": KENNEL, "r": record(shared=1, private=2)}
    found = completer.IPCompleter(SimpleNamespace(user_ns=place), namespace=place)
    with completer.provisionalcompleter():
        assert "Dog" in {it.text.strip(".") for it in found.completions("t.Do", 4)}
        assert "shared" in {it.text.strip("'\"]") for it in found.completions('r["', 3)}
        place["r"] = record(shared=record(latest=1))
        found.use_jedi, found.evaluation = False, "unsafe"
        line = "r.shared.la"
        assert ".latest" in {it.text for it in found.completions(line, len(line))}


DOG = Pred("dog", Ind)
FIDO = rectype(x=Ind, c=DOG(this.x))


def test_free_names_of_a_value_are_names() -> None:
    from ttr.types.objects import Path

    @dataclass(frozen=True)
    class Free(NotebookValue):
        def _shown_as_(self) -> Part:
            return Value(DOG(Path(0, ("s", "x"))), free=("s",))

    assert plain(Free()) == "dog(s.x)"
