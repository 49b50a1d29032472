"""Property tests of rules: what they find, how they tell it, what they leave alone."""

from itertools import count

import pytest
from hypothesis import settings
from hypothesis.stateful import run_state_machine_as_test

from ttr import (
    Basic,
    Ind,
    ListOf,
    Model,
    Pred,
    RecType,
    Theory,
    TTRError,
    record,
    rectype,
    replace,
    testing,
    this,
)
from ttr.dialogues.stories import play as play_story
from ttr.dialogues.stories import read_stories, setting
from ttr.testing import Breach, Property, Roles, Suite, Tutor
from ttr.testing import strategies as tst
from ttr.updates import Game, by_class, first, maybe, nbest, repeat, rule, seq

Word = Basic("Word")
say = Pred("say", Word)
Board = rectype(heard=ListOf(Word), agenda=ListOf(RecType), loud=ListOf(Word))
Saying = rectype(w=Word, e=say(this.w))
M = Model().given("hi", Word).given("ho", Word)
START = record(heard=[], agenda=[], loud=[])


@rule(when=Board, on=Saying)
def note(s, e):
    "What is said is heard."
    return replace(s, heard=[*s.heard, e.w])


@rule(when=Board, on=Saying)
def stutter(s, e):
    return replace(s, heard=[*s.heard, e.w, e.w])


def game_of(algorithm, start=START, **options):
    return Game("words", Board, start, algorithm, M, **options)


GOOD = game_of(note)


def failing(*rules, **options):
    """The text of what is wrong with a game of rules."""
    with pytest.raises(AssertionError) as caught:
        testing.check_rules(game_of(first(*rules)), **{"examples": 50, **options})
    return str(caught.value)


# --- what is found -------------------------------------------------------------------


def test_good_rules_pass_and_tell_what_was_covered():
    report = testing.check_rules(GOOD, examples=50)
    assert report.holds
    assert report.coverage.dialogues == 50
    assert report.coverage.missed_rules == ()
    assert report.coverage.rules["note"] > 100
    assert {one.name for one, _ in report.skipped} == {
        *("P8", "P9", "P10", "P16", "P22", "P24", "P26")
    }


@rule(when=Board, on=Saying)
def misfit(s, e):
    return replace(s, heard=[*s.heard, 7])


@rule(when=Board, on=Saying)
def crash(s, e):
    return replace(s, heard=[s.heard[3]])


hidden = count()


@rule(when=Board, on=Saying)
def moody(s, e):
    return replace(s, heard=[*s.heard, e.w] if next(hidden) % 2 else ())


@rule(when=Board, on=Saying)
def scribble(s, e):
    s._fields["loud"] = (e.w,)
    return replace(s, heard=[*s.heard, e.w])


@pytest.mark.parametrize(
    ("broken", "name", "why"),
    [
        (misfit, "P1", "after misfit the state is not of its type"),
        (crash, "P17", "the rule crash failed: IndexError"),
        (moody, "P3", ""),
        (scribble, "P2", "a rule changed the state it was given, at loud"),
    ],
)
def test_faults_of_one_rule_are_found(broken, name, why):
    told = failing(broken, properties=[name])
    assert told.startswith(f"{name} ")
    assert why in told


def test_an_error_that_a_tutor_raises_once_is_told():
    asked = count()

    def moves(s, model):
        if next(asked) == 37:
            raise OSError("the file is being written")
        return [{"w": "hi"}, {"w": "ho"}]

    told = failing(note, tutor=Tutor(moves=moves), properties=["P3"])
    assert told.startswith("P3 ")
    assert "once there was OSError: the file is being written" in told


def test_a_repetition_without_an_end_is_found():
    @rule(when=Board)
    def again(s):
        return replace(s, heard=[*s.heard, "hi"][-3:], loud=[*s.loud, "hi"][-2:])

    told = failing(seq(note, maybe(repeat(again, times=50))), properties=["P4"])
    assert told.startswith("P4 termination: every repetition, and every agenda")


def test_the_order_of_rules_in_a_class_is_found_to_matter():
    @rule(when=Board, on=Saying, kind="hear")
    def as_heard(s, e):
        return replace(s, heard=[*s.heard, e.w])

    @rule(when=Board, on=Saying, kind="hear")
    def as_shouted(s, e):
        return replace(s, loud=[*s.heard, e.w])

    classes = by_class(as_heard, as_shouted, order=["hear"])
    told = failing(classes, properties=["P5"])
    assert "in the class hear, as_heard and as_shouted" in told or (
        "as_heard, as_shouted lead elsewhere than as_shouted, as_heard" in told
    )


def test_rules_of_a_class_may_make_up_different_names():
    Named = rectype(one=ListOf(Ind), two=ListOf(Ind))

    def naming(label):
        def give(s, e, *, model):
            name, model = model.create(Ind)
            return replace(s, {label: [*s[label], name]}), model

        give.__name__ = label
        return rule(when=Named, on=Saying, kind="name")(give)

    both = by_class(naming("one"), naming("two"), order=["name"])
    game = Game("names", Named, record(one=[], two=[]), both, M)
    assert testing.check_rules(game, properties=["P5"], examples=20).holds


@pytest.mark.slow
def test_a_rule_that_never_applies_is_dead_after_many_turns():
    @rule(when=Board, on=rectype(w=Word @ "hi", e=say("ho")))
    def late(s, e):
        return s

    game = game_of(first(note, late), hears=(Saying,))
    suite = Suite(game, properties=(by_name("P6"),), examples=700)
    ((found, why),) = suite.played().overall
    assert found.name == "P6"
    assert why.startswith("late is never applied in")


def by_name(name):
    return next(one for one in testing.ALL if one.name == name)


def test_static_faults_come_before_any_dialogue():
    @rule(when=Board, on=Saying)
    def slip(s, e):
        return replace(s, herad=[*s.heard, e.w])

    told = failing(slip)
    assert "herad" in told
    assert "did you mean heard?" in told
    report = Suite(game_of(slip), examples=10).run()
    assert (report.coverage.dialogues, report.holds) == (0, False)


def test_nbest_events_are_played_and_tested():
    tutor = Tutor(moves=(nbest((Saying, 0.6), (record(w="hi", e="s9"), 0.3)), Saying))
    listening = rule(when=Board, on=Saying, p=0.5)(note.effect)
    game = game_of(listening, hears=(Saying,))
    report = testing.check_rules(game, tutor=tutor, examples=30)
    assert report.coverage.turns > 100


# --- what is needed to check ---------------------------------------------------------


def test_roles_are_found_by_the_names_of_the_literature():
    kos = rectype(facts=RecType, qud=ListOf(Ind), moves=ListOf(Ind))
    assert Roles.of(rectype(dgb=kos)) == Roles(qud="dgb.qud", commitments="dgb.facts")
    assert Roles.of(rectype(qud=Ind)) == Roles()


def test_a_property_of_ones_own_is_checked_as_the_others_are():
    def grows_by_one(dialogue, roles):
        for number, trial in enumerate(dialogue.trials, start=1):
            more = len(trial.after.state.heard) - len(trial.before.state.heard)
            if more > 1:
                yield number, f"{more} words more"

    own = Property("own", "one at a time", "one word is heard a turn.", grows_by_one)
    told = failing(stutter, properties=[own])
    assert told.startswith("own one at a time: one word is heard a turn.\nturn 1: 2 ")
    assert testing.check_rules(GOOD, properties=[own], examples=20).holds


def judged(name, game, roles, *given):
    """Why one dialogue breaks a property; an empty text if it does not."""
    breach = by_name(name).breach(tst.play(game, given), roles)
    return "" if breach is None else breach.why


Facts = rectype(com=RecType)
Hi, Ho = rectype(a=say("hi")), rectype(b=say("ho"))
AGREED = Roles(commitments="com")


@pytest.mark.parametrize(
    ("after", "why"),
    [(Hi & Ho, ""), (Hi, ""), (Ho, "which is no longer [a : say(hi)]")],
)
def test_what_is_agreed_on_may_be_a_record_type(after, why):
    @rule(when=Facts, on=Saying)
    def agree(s, e):
        return replace(s, com=after)

    game = Game("facts", Facts, record(com=Hi), agree, M)
    found = judged("P10", game, AGREED, Saying)
    assert why in found
    assert bool(found) == bool(why)


def test_rules_that_take_back_may():
    @rule(when=Board, on=Saying)
    def forget(s, e):
        return replace(s, heard=[])

    game, roles = game_of(forget, record(heard=["hi"], agenda=[], loud=[])), "heard"
    assert judged("P10", game, Roles(commitments=roles), Saying)
    pardoned = Roles(commitments=roles, retracts=frozenset({"forget"}))
    assert not judged("P10", game, pardoned, Saying)


def test_a_dialogue_that_is_over_need_not_go_on():
    @rule(when=rectype(heard=ListOf(Word) @ ()), on=Saying)
    def once(s, e):
        return replace(s, heard=[e.w])

    over = rectype(heard=ListOf(Word) @ ("hi",))
    hi = rectype(w=Word @ "hi", e=say(this.w))
    assert "is stuck here" in judged("P14", game_of(once), Roles(), hi)
    assert not judged("P14", game_of(once), Roles(over=over), hi)


def test_what_the_tutor_may_say_is_a_way_on():
    @rule(when=Board, on=rectype(w=Word @ "hum", e=say(this.w)))
    def only_hum(s, e):
        return replace(s, heard=[*s.heard, e.w])

    hum = rectype(w=Word @ "hum", e=say(this.w))
    game = game_of(only_hum, hears=(Saying,), hear={"hum": hum, "hi": Saying}.get)
    tutor = Tutor(moves=("hi", "hum"))
    assert "is stuck here" in judged("P14", game, Roles(), Saying)
    assert Suite(game, tutor, (by_name("P14"),), examples=20).played().holds


def test_moves_of_which_nothing_is_made_are_told():
    @rule(when=rectype(heard=ListOf(Word) @ ()), on=Saying)
    def once(s, e):
        return replace(s, heard=[e.w])

    told = judged("P13", game_of(once), Roles(spoken=Saying), Saying, Saying)
    assert told.startswith("no rule takes ")
    assert not judged("P13", game_of(once), Roles(), Saying, Saying)


def test_words_that_are_read_as_something_else_are_told():
    def hear(text):
        return rectype(w=Word @ "ho", e=say(this.w)) if text == "ho" else Saying

    speaking = game_of(note, hear=hear)
    roles = Roles(words=lambda event: event.w if event.w in ("hi", "ho") else None)
    wrong = rectype(w=Word @ "hi", e=say(this.w))
    assert judged("P16", speaking, roles, wrong) == ""
    misheard = game_of(note, hear=lambda text: rectype(w=Word @ "ho", e=say(this.w)))
    assert "is worded 'hi', which is read as" in judged("P16", misheard, roles, wrong)
    deaf = game_of(note, hear={}.__getitem__)
    assert "cannot be read: KeyError" in judged("P16", deaf, roles, wrong)


def test_questions_go_when_they_are_answered():
    Asked = rectype(qud=ListOf(Word))

    @rule(when=Asked, on=Saying)
    def pop(s, e):
        return replace(s, qud=s.qud[1:])

    game = Game("asked", Asked, record(qud=["hi", "ho"]), pop, M)
    hi, ho = (rectype(w=Word @ w, e=say(this.w)) for w in ("hi", "ho"))
    roles = Roles(qud="qud", answers=lambda event, question: event.w == question)
    assert judged("P8", game, roles, hi) == ""
    assert judged("P8", game, roles, ho) == "pop drops hi, which nothing resolves"
    dropping = Roles(qud="qud", answers=roles.answers, drops=frozenset({"pop"}))
    assert judged("P8", game, dropping, ho) == ""


# --- how it is told ------------------------------------------------------------------


def at_most_three(dialogue, roles):
    for number, trial in enumerate(dialogue.trials, start=1):
        if len(trial.after.state.heard) > 3:
            yield number, "too many"


SHORT = Property("short", "short", "three words are enough.", at_most_three)


def test_the_dialogue_is_the_shortest_that_fails():
    report = Suite(GOOD, properties=(SHORT,), examples=50).played()
    assert [trial.given is not None for trial in report.broken.dialogue.trials] == (
        [True] * 4
    )
    assert report.broken.why == Breach(SHORT, 4, "too many")


def test_what_is_told_is_a_story_that_fails_in_the_same_way(tmp_path):
    theory = tmp_path / "words.ttr"
    theory.write_text(
        """
        basic Word
        object hi, ho : Word
        pred say(Word)
        Words  := list(Word)
        Board  := [heard : Words, left : Words]
        Saying := [w : Word, e : say(w)]
        rule note(s : Board, e : Saying) := [left = rst(s.left) : Words]
        game words({heard = [], left = [hi]} : Board) := note
        """
    )
    place = setting("words.ttr words", tmp_path)
    report = Suite(place.game, examples=20).played()
    told = report.explain_failure(place)
    assert told.startswith("P")
    story = told[told.index("--- ") :]
    (tmp_path / "found.dlg").write_text(story)
    (found,) = read_stories(tmp_path / "found.dlg")
    played = play_story(found, place)
    assert played.mismatch is not None
    assert "note" in str(played.mismatch)


def test_the_same_seed_finds_the_same():
    def run(seed):
        return testing.check_rules(GOOD, examples=30, seed=seed).coverage

    assert run(1).facts() == run(1).facts()
    assert run(1).pairs != run(2).pairs or run(1).turns != run(2).turns


# --- rules without a game, and single rules ------------------------------------------


def test_a_list_of_rules_is_tested_over_states_of_the_type():
    report = testing.check_rules([note], Board, model=M, examples=50)
    assert report.coverage.rules["note"] > 50
    with pytest.raises(AssertionError, match="P1 type preservation"):
        testing.check_rules([misfit], Board, model=M, examples=50, properties=["P1"])


def test_states_are_drawn_in_which_the_conditions_hold():
    full = rule(when=rectype(heard=ListOf(Word) @ ("hi", "ho", "hi")), on=Saying)
    rare = full(lambda s, e: replace(s, heard=[]))
    report = testing.check_rules([rare], Board, model=M, examples=50)
    assert report.coverage.rules["<lambda>"] > 5


def test_one_rule_is_tested_by_itself():
    assert testing.check_rule(note, Board, model=M, examples=30).coverage.turns == 30
    for broken, name in [(misfit, "P1"), (crash, "P17"), (scribble, "P2")]:
        with pytest.raises(AssertionError, match=name):
            testing.check_rule(broken, Board, model=M, examples=50)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        (lambda: testing.check_rules([note]), "over states of a record type"),
        (lambda: testing.check_rules([], Board), "one rule at least"),
        (lambda: testing.check_rules("note", Board), "are rules or a game"),
        (lambda: testing.check_rules(7, Board), "are rules or a game"),
        (lambda: testing.check_rules(["note"], Board), "first takes rules"),
        (
            lambda: testing.check_rules(GOOD, properties=["P99"]),
            "is one of P1, P2, .*, P27, or one's own, found 'P99'",
        ),
        (lambda: testing.check_rules(GOOD, tutor=3), "a tutor is a Tutor"),
        (lambda: testing.check_rules(GOOD, examples=0), "a number from 1 on, found 0"),
        (lambda: testing.on_dialogues(GOOD, examples=0)(print), "a number from 1 on"),
        (lambda: testing.check_rule(GOOD, Board), "one rule is checked"),
        (lambda: testing.machine(3), "a machine is made of a game"),
        (lambda: testing.on_dialogues(3), "dialogues are drawn of a game"),
        (lambda: testing.on_dialogues(GOOD)(lambda: 0), "takes one dialogue"),
        (lambda: tst.dialogues(3), "dialogues are drawn of a game"),
        (lambda: tst.dialogues(GOOD, turns=0), "a turn at least"),
        (lambda: tst.events([]), "of a type at least"),
        (lambda: tst.states(Ind), "states are drawn for a record type"),
        (lambda: Tutor(answers=2), "answers is a share from 0 to 1"),
        (
            lambda: Tutor(answers=0, wanders=0, contradicts=0, repeats=0, silent=0),
            "one share at least",
        ),
    ],
)
def test_wrong_use_is_told_in_a_line(wrong, told):
    with pytest.raises(TTRError, match=told) as caught:
        wrong()
    assert "\n" not in caught.value.message


def test_a_report_prints_what_was_covered():
    report = testing.check_rules(GOOD, examples=5)
    assert str(report) == report.coverage.table()


# --- pytest and Hypothesis -----------------------------------------------------------


@testing.on_dialogues(GOOD, examples=20)
def test_a_decorated_test_is_given_each_dialogue(dialogue):
    assert len(dialogue.states) == len(dialogue.trials) + 1


def test_a_decorated_test_that_fails_tells_the_shortest_story():
    @testing.on_dialogues(GOOD, examples=50)
    def test_two_words(dialogue):
        assert len(dialogue.now.state.heard) < 2

    with pytest.raises(AssertionError) as caught:
        test_two_words()
    (note,) = caught.value.__notes__
    assert "--- two words" in note
    assert note.count("U> ") == 2


def test_a_machine_plays_and_checks():
    few = settings(max_examples=10, stateful_step_count=5, database=None)
    run_state_machine_as_test(testing.machine(GOOD), settings=few)
    wrong = testing.machine(game_of(misfit))
    with pytest.raises(AssertionError, match="P1 type preservation"):
        run_state_machine_as_test(wrong, settings=few)


def test_a_rule_that_weighs_all_that_may_have_been_heard_is_pure():
    @rule(when=Board, on=Saying, p=0.01)
    def weigh(s, e, *, nbest):
        told = [one for one, _ in nbest] if hasattr(nbest, "alternatives") else [e]
        return replace(s, heard=[*s.heard, told[-1].w])

    events = [record(w=word, e=f"said {word}") for word in ("hi", "ho")]
    model = M
    for event in events:
        model = model.given(event.e, say(event.w))
    game = Game("words", Board, START, weigh, model)
    both = nbest((events[0], 0.6), (events[1], 0.4))
    dialogue = testing.play(game, [both])
    assert dialogue.now.state.heard == ("ho",)
    assert (
        next(p for p in testing.ALL if p.name == "P2").breach(dialogue, Roles()) is None
    )


def test_what_fails_is_shown_where_it_fails():
    @testing.on_dialogues(GOOD, examples=20)
    def test_silence(dialogue):
        assert not dialogue.now.state.heard

    with pytest.raises(AssertionError) as caught:
        test_silence()
    frames = [entry.name for entry in caught.traceback]
    assert frames[-2:] == ["play_many", "test_silence"]
    assert caught.value.__suppress_context__


@pytest.mark.parametrize(
    ("fields", "found"),
    [
        ({"issues": ListOf(Ind)}, {"qud": "issues"}),
        ({"qud": ListOf(Ind), "issues": ListOf(Ind)}, {"qud": "qud"}),
        ({"agenda": ListOf(RecType)}, {"agenda": "agenda"}),
        ({"plan": ListOf(Ind)}, {}),
        ({"floor": Ind}, {"speaker": "floor"}),
        ({"floor": ListOf(Ind)}, {}),
        ({"dgb": rectype(pending=ListOf(Ind))}, {"pending": "dgb.pending"}),
        ({"cg": RecType}, {"commitments": "cg"}),
        ({"cg": Ind}, {}),
    ],
)
def test_a_field_plays_a_role_by_its_name_and_its_type(fields, found):
    assert Roles.of(rectype(**fields)).paths == found


DESK = """
    basic Ind, Topic
    object guest, clerk : Ind
    object museum, trains : Topic
    pred ask(Ind, Topic), tell(Ind, Topic), cancel(Ind, Topic)
    Ask    := [spkr = guest : Ind, t : Topic, e : ask(spkr, t)]
    Tell   := [spkr = clerk : Ind, t : Topic, e : tell(spkr, t)]
    Cancel := [spkr = guest : Ind, t : Topic, e : cancel(spkr, t)]
    Topics := list(Topic)
    Board  := [qud : Topics, facts : Topics]
    Open   := [qud : nelist(Topic)]
    rule asked(s : Board /\\ [qud = [] : Topics], e : Ask) := [qud = [e.t] : Topics]
    rule told(s : Board /\\ Open, e : Tell)
        where [t = e.t : Topic, asked = fst(s.qud) : Topic@t] := {told}
    rule cancelled(s : Board /\\ Open, e : Cancel)
        where [t = e.t : Topic, asked = fst(s.qud) : Topic@t]
        := [qud = rst(s.qud) : Topics]
    game desk({{qud = [], facts = []}} : Board) := first(told, cancelled, asked)
"""


@pytest.mark.parametrize(
    ("name", "told", "found"),
    [
        (
            "P8",
            "[facts = [e.t] + s.facts : Topics]",
            ": told put it on facts, let it take it off qud, too, as by qud = ",
        ),
        (
            "P26",
            "[qud = s.qud : Topics]",
            "they are taken off by cancelled; "
            "events about a question leave it, and facts, as they are in told",
        ),
    ],
)
def test_what_stays_or_goes_without_effect_is_told_with_the_rules(name, told, found):
    game = Theory.parse(DESK.format(told=told)).games["desk"]
    suite = Suite(game, properties=(by_name(name),), examples=80)
    assert found in suite.played().explain_failure()
