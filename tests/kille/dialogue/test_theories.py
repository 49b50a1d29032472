"""Robots with theories of their own: nothing is of another theory but by its name."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest

import kille
from kille.agent.agent import Agent
from kille.agent.story_replay import play
from kille.dialogue import meanings
from kille.dialogue.games import TUTORING
from kille.dialogue.language import understand
from kille.dialogue.meanings import DialogueTypes, packaged_types, record_type
from kille.dialogue.rules import NamedRule, bind, rule
from kille.dialogue.tutoring import tutoring
from kille.lab.worlds.games import simulated_game
from kille.lab.worlds.perception import glance_event, look_event
from kille.lab.worlds.worlds import Thing, World
from ttr import Model, Rec, Theory, record
from ttr.dialogues.stories import read_stories
from ttr.errors import UpdateError
from ttr.updates import Game, Rule, first, maybe, replace_rules, rules_of, run

BASIC = "basic Ind, Look, Front, Text, Number\n"

RENAMED = """\
basic Entity, Glimpse, Direction, Wording, Quantity
Ind := Entity
Look := Glimpse
Front := Direction
Text := Wording
Number := Quantity
"""

WORLD = World(
    (
        Thing("cup", "red", 0.9, (2, 3)),
        Thing("car", "blue", 0.1, (7, 3)),
        Thing("book", "green", 0.9, (5, 6)),
    )
)

SCRIPT = {
    "en": """
        Hello. | #1 | What is this? | This is a cup. | What is this? | Yes. | Why?
        How sure are you? | #2 | This is a car. | What colour is this? | This is big.
        This is to the right of the cup. | Where is the car? | Is this a cup?
        No, it is a mug. | Is the cup to the left of the mug? | The mug faces left.
        Is the cup behind the mug? | From my perspective. | As the mug sees it.
        What do you see? | How many cups are there? | Show me the red cup.
        Where is the mug? | The one on the left. | #3 | This is a cupp. | Yes. | No.
        These are cups. | Where are the cups? | Where is the blicket?
        Where is the cup? | The red one. | What do you know? | What is a cup?
        Forget that. | Forget the last one. | Forget mug. | This is not a book.
        Say that again. | Help. | Thank you. | OK. | Goodbye. | wait
    """,
    "sv": """
        Hej. | #1 | Vad är det här? | Det här är en kopp. | Vad är det här? | Ja.
        #2 | Det här är en bil. | Det här är till höger om koppen. | Var är bilen?
        Nej, det är en mugg. | Vad ser du? | Glöm det. | Hej då.
    """,
}


def packaged() -> str:
    """The text of the packaged theory."""
    return files("kille.grammars").joinpath("tutor.ttr").read_text(encoding="utf-8")


@pytest.fixture
def renamed() -> DialogueTypes:
    """The packaged theory, in which no basic type is the same as it is there."""
    assert BASIC in packaged()
    return DialogueTypes(Theory.parse(packaged().replace(BASIC, RENAMED)))


@pytest.fixture
def without_packaged(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """No packaged theory: who asks for it fails."""

    def refuse() -> Theory:
        raise AssertionError("this asks for the packaged theory")

    monkeypatch.setattr(meanings, "packaged_theory", refuse)
    packaged_types.cache_clear()
    yield
    packaged_types.cache_clear()


def talk(game: Game, language: str, types: DialogueTypes) -> Iterator[str]:
    """What the game says to the script, and the rules by which it does."""
    assert game.say is not None
    now, world = game.begin(), WORLD
    for line in SCRIPT[language].replace("\n", "|").split("|"):
        text = line.strip()
        if text.startswith("#"):
            before, world = world, world.point_at(int(text[1:]))
            turn = game.take(now, glance_event(world, before))
        elif text == "wait":
            before, world = world, world.look_again()
            turn = game.take(now, look_event(world, before))
        elif text:
            assert game.hear is not None
            event = game.hear(text)
            assert event is not None, text
            turn = game.take(now, event)
        else:
            continue
        now = turn.run
        yield " ".join(map(game.say, turn.said)) + str(
            [s.rule.name for s in turn.trace]
        )


@pytest.mark.parametrize("language", SCRIPT)
def test_a_game_of_another_theory_never_asks_for_the_packaged_one(
    language: str, renamed: DialogueTypes, request: pytest.FixtureRequest
) -> None:
    usual = packaged_types()
    said = list(talk(simulated_game(WORLD, language=language), language, usual))
    expected = [
        it.replace("look : Look, x : Ind", "look : Glimpse, x : Entity") for it in said
    ]
    request.getfixturevalue("without_packaged")
    game = simulated_game(WORLD, language=language, types=renamed)
    assert list(talk(game, language, renamed)) == expected


STORIES = Path(__file__).parents[2] / "dialogues"


def test_a_robot_of_another_theory_never_asks_for_the_packaged_one(
    renamed: DialogueTypes, without_packaged: None
) -> None:
    for one in read_stories(STORIES / "offering.dlg"):
        assert play(one, make=partial(Agent, theory=renamed.theory)) is None


# --- many theories at once -----------------------------------------------------------

GREETINGS = {
    "greet_back": "Hello.",
    "welcome": "You are welcome.",
    "part": "Goodbye.",
    "noted": "OK.",
    "no_claim": "I have not claimed anything.",
    "nothing_said": "I have not said anything yet.",
    "acknowledge": "Great!",
    "same_thing": "That would be one and the same thing.",
    "resign": "Then I do not know which one you mean.",
    "pardon": "Pardon? I did not hear you well.",
}
"""Ten ways to return a greeting, by the predicates of moves."""


def greeting(act: str) -> Theory:
    """The theory in which greetings are returned by this move, and the reverse."""
    names = {"greet_back": act, act: "greet_back"}
    return Theory.parse(re.sub(r"\w+", lambda it: names.get(it[0], it[0]), packaged()))


def test_ten_robots_have_ten_theories_and_each_answers_by_its_own() -> None:
    robots = {
        act: Agent(sensor="synthetic:empty", theory=greeting(act)) for act in GREETINGS
    }
    try:
        for _ in range(2):
            for act, robot in robots.items():
                assert robot.hear("Hello.") == GREETINGS[act]
    finally:
        for robot in robots.values():
            robot.close()


def test_ten_robots_in_threads_answer_each_by_its_own() -> None:
    def answers(act: str) -> tuple[str, str, list[str]]:
        types = DialogueTypes(greeting(act))
        with Agent(sensor="synthetic:empty", theory=types) as robot:
            hello, again = robot.hear("Hello."), robot.hear("Hello.")
        return hello, again, list(talk(simulated_game(WORLD, types=types), "en", types))

    with ThreadPoolExecutor(5) as pool:
        found = list(pool.map(answers, GREETINGS))
    assert [it[:2] for it in found] == [(it, it) for it in GREETINGS.values()]
    assert all(said[0].startswith(hello) for hello, _, said in found)
    learned = [[it for it in said if "a cup" in it] for _, _, said in found]
    assert learned == learned[:1] * len(learned)
    assert learned[0]


def test_languages_and_modes_live_beside_one_another() -> None:
    english = Agent(sensor="synthetic:empty", theory=greeting("part"))
    swedish = Agent(sensor="synthetic:empty", language="sv", theory=greeting("noted"))
    with english, swedish:
        said = [english.hear("Hello."), swedish.hear("Hej."), english.hear("Hello.")]
    assert said == ["Goodbye.", "Okej.", "Goodbye."]


def test_what_is_understood_is_of_the_types_that_were_given(
    renamed: DialogueTypes,
) -> None:
    for types in (renamed, packaged_types(), renamed):
        [said] = understand("Where is the book?", types=types)
        assert said.readings[0].type <= types.record_type("AskPlace")
    assert not said.readings[0].type <= record_type("AskPlace")


# --- rules on names ------------------------------------------------------------------


@rule(answers="Greet")
def be_curt(s: Any, *, types: DialogueTypes) -> Any:
    """A greeting is not returned."""
    return s if types["Greet"] is None else None


def test_rules_are_bound_once_for_each_theory(renamed: DialogueTypes) -> None:
    usual, other = (bind(TUTORING, it) for it in (packaged_types(), renamed))
    assert bind(TUTORING, packaged_types()) is usual
    assert str(usual) == str(other) == str(TUTORING)
    for named_, one, another in zip(
        rules_of(TUTORING), rules_of(usual), rules_of(other), strict=True
    ):
        assert isinstance(named_, NamedRule)
        assert {type(one), type(another)} == {Rule}
        assert named_.name == one.name == another.name
        assert (named_.doc, named_.span) == (one.doc, one.span)
        assert one.when is not another.when
        assert (one.takes, one.names, one.p) == (named_.takes, named_.names, named_.p)


def test_a_rule_of_another_kind_stays_as_it_is() -> None:
    bound = bind(be_curt, packaged_types())
    whole = first(maybe(be_curt), bound)
    assert bind(whole, packaged_types()) == first(maybe(bound), bound)


def test_a_rule_is_played_when_it_is_bound() -> None:
    with pytest.raises(
        UpdateError, match="the rule be_curt is on types by their names"
    ):
        run(be_curt, record(), type=Rec, model=Model())


def test_a_rule_is_where_it_was_written() -> None:
    assert be_curt.span is not None
    assert Path(be_curt.span.source) == Path(__file__)
    assert be_curt.doc == "A greeting is not returned."


def test_a_rule_in_the_place_of_another_is_bound_with_the_rest() -> None:
    @rule(answers="Greet")
    def greet(s: Any, *, types: DialogueTypes) -> None:
        """Nothing is said."""

    (old,) = [it for it in rules_of(TUTORING) if it.name == "GreetBack to Greet"]
    game = tutoring(rules=replace_rules(TUTORING, {old.name: greet}))
    assert game.hear is not None
    assert game.take(game.begin(), game.hear("Hello.")).said == ()


@pytest.mark.parametrize("rules", [{"when": "Nowhere"}, {"on": "Nothing"}])
def test_a_name_that_a_theory_does_not_have_is_told(rules: dict[str, str]) -> None:
    effect = (lambda s, e: s) if "on" in rules else (lambda s: s)
    with pytest.raises(KeyError, match="the theory has no No"):
        bind(rule(**rules)(effect), packaged_types())  # type: ignore[arg-type]


# --- nothing asks for it silently ----------------------------------------------------

ROOM = Path(kille.__file__).parent

OF_THE_PACKAGED = {
    *("theory", "record_type", "move_type", "sign", "noun", "adjective", "relation"),
    *("kind_in", "meaning_in", "meaning_at"),
}
"""What is about the packaged theory."""

ITS_OWN = {"dialogue_properties.py"}
"""What is told of dialogues by the packaged theory, whatever theory they are of."""


def test_only_properties_ask_for_the_packaged_theory() -> None:
    asking = {
        file.name
        for file in ROOM.rglob("*.py")
        for node in ast.walk(ast.parse(file.read_bytes()))
        if isinstance(node, ast.ImportFrom) and node.module == meanings.__name__
        for name in node.names
        if name.name in OF_THE_PACKAGED
    }
    assert asking == ITS_OWN


def test_what_needs_types_in_a_game_is_given_them() -> None:
    files_ = [*(ROOM / "dialogue").rglob("*.py"), *(ROOM / "agent").rglob("*.py")]
    trees = {file: ast.parse(file.read_bytes()) for file in files_}
    wanting = {
        (module_of(file), node.name)
        for file, tree in trees.items()
        for node in tree.body
        if isinstance(node, ast.FunctionDef)
        and any(it.arg == "types" for it in node.args.kwonlyargs)
    }
    lacking = []
    for file, tree in trees.items():
        known = {name for module, name in wanting if module == module_of(file)}
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and node.module:
                for one in node.names:
                    if any(
                        module.startswith(node.module) and name == one.name
                        for module, name in wanting
                    ):
                        known.add(one.name)
        known |= {"PhraseJudge"}
        lacking += [
            f"{file.name}:{call.lineno}: {call.func.id}"
            for call in ast.walk(tree)
            if isinstance(call, ast.Call)
            and isinstance(call.func, ast.Name)
            and call.func.id in known
            and not any(it.arg == "types" for it in call.keywords)
        ]
    assert len(wanting) > 100
    assert lacking == []


def module_of(file: Path) -> str:
    """The name of the module in a file of `kille`."""
    return ".".join(("kille", *file.relative_to(ROOM).with_suffix("").parts))
