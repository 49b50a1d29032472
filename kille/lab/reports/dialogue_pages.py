"""Pages of dialogues: what all theories were told and said, and lists that lead there.

Each number of a report leads to one of them. They need nothing but the report's folder.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import combinations, cycle

from kille.lab.dialogues import Turn
from kille.lab.measures.comparison import in_pairs
from kille.lab.measures.measures import ACCURACY, value
from kille.lab.measures.scored_dialogues import ScoredAnswer, ScoredDialogue
from kille.lab.reports.elements import Markup, element, join, link, scrolling_table
from kille.lab.reports.events import describe_event
from kille.lab.reports.figure_styles import HUES
from kille.lab.reports.findings import Theories
from kille.lab.reports.links import Places
from kille.lab.reports.result_pages import table_element, whole_page
from kille.lab.reports.styles import DIALOGUES, THEORIES
from kille.lab.results import Cell, Table
from ttr.escapes import html_address

Page = tuple[str, str]
"""The name of a file, and what is in it."""

_Piece = tuple[str, str, Iterable[Markup]]


def pages(theories: Theories, places: Places, report: str) -> Iterator[Page]:
    """All pages, each with the name of its file in the folder of the places.

    `report` is the name of the page that leads to them, a folder further out.
    """
    back = element("p", link("report", f"../{html_address(report)}"))
    for place, title, body in _pages(theories, places):
        file = place.partition("#")[0].rpartition("/")[2]
        yield file, whole_page(title, [back, *body], None, THEORIES + DIALOGUES)


def _pages(theories: Theories, places: Places) -> Iterator[_Piece]:
    """The place, the title and the body of each page."""
    occasions: dict[tuple[str, str, int], list[ScoredDialogue]] = {}
    for them in theories.values():
        for it in them:
            occasions.setdefault(it.pair, []).append(it)
    for them in occasions.values():
        title = f"Dialogue {places.pairs[them[0].pair]}: {_title(them[0])}"
        yield places.dialogue(them[0].run), title, _side_by_side(them, places)
    for name, them in theories.items():
        yield places.theory(name), name, _dialogue_lists(name, them, places)
        title = f"{name}: all answers"
        yield places.answers(name), title, _answer_lists(name, them, places)
    for one, other in combinations(theories, 2):
        title = f"{other} against {one}"
        body = _differences(theories[one], theories[other], places)
        yield places.against(one, other), title, body


def _beside(place: str) -> str:
    """A place as seen from another page."""
    return place.rpartition("/")[2]


def _title(dialogue: ScoredDialogue) -> str:
    tutor, scene, seed = dialogue.pair
    return f"{tutor}, {scene}, seed {seed}"


# --- what was said -------------------------------------------------------------------


def _side_by_side(
    dialogues: Sequence[ScoredDialogue], places: Places
) -> Iterator[Markup]:
    """What each theory was told and said: phase by phase, each from the same height."""
    hues = dict(zip(places.theories, cycle(HUES), strict=False))

    def columns(of: Callable[[ScoredDialogue], Iterator[Markup]]) -> Markup:
        cards = (
            element(
                "div",
                *of(it),
                id=anchor(it) if of is heading else "",
                style=f"--hue: {hues[it.run.theory]}",
            )
            for it in dialogues
        )
        return element("div", *cards, class_="theories")

    def heading(it: ScoredDialogue) -> Iterator[Markup]:
        name = it.run.theory
        yield element("h4", link(name, _beside(places.theory(name))))
        yield element("p", _summary(it), class_="note")

    def anchor(it: ScoredDialogue) -> str:
        return f"theory-{places.theories[it.run.theory]}"

    yield columns(heading)
    for phase in dict.fromkeys(turn.phase for it in dialogues for turn in it.turns):

        def turns(it: ScoredDialogue, phase: str = phase) -> Iterator[Markup]:
            if len(dialogues) > 1:
                yield element("p", it.run.theory, class_="called")
            yield from _turns(it, phase, f"{anchor(it)}-turn")

        yield element("h3", phase) + columns(turns)


def _summary(dialogue: ScoredDialogue) -> str:
    right = sum(it.is_right for it in dialogue.answers)
    turns = sum(it.turns for it in dialogue.efforts)
    words = sum(it.words for it in dialogue.efforts)
    return (
        f"{right} of {len(dialogue.answers)} right, {dialogue.lessons} lessons kept, "
        f"{turns} turns and {words} words of the tutor"
    )


def _turns(dialogue: ScoredDialogue, phase: str, anchor: str) -> Iterator[Markup]:
    """The turns of a phase, with the names of the tutors if there are several."""
    answers: dict[int, list[ScoredAnswer]] = {}
    for answer in dialogue.answers:
        answers.setdefault(answer.turn, []).append(answer)
    several = len({turn.tutor for turn in dialogue.turns}) > 1
    for turn in dialogue.turns:
        if turn.phase == phase:
            lines = [_input(turn, several)] if turn.given else []
            if turn.answer:
                lines.append(element("p", turn.answer, class_="robot"))
            for it in answers.get(turn.number, ()):
                lines.append(element("p", _mark(it), " ", _describe_answer(it)))
            number = element("span", str(turn.number))
            place = f"{anchor}-{turn.number}"
            yield element("div", number, *lines, class_="turn", id=place)


def _input(turn: Turn, names_tutor: bool) -> Markup:
    """What the tutor said, or what happened."""
    if not turn.words:
        return element("p", describe_event(turn.given), class_="happens")
    who = [element("span", f"{turn.tutor}:", class_="who"), " "] * names_tutor
    return element("p", *who, turn.given)


def _mark(answer: ScoredAnswer) -> Markup:
    if answer.is_right:
        return element("span", "✓", class_="yes")
    return element("span", "✗", class_="no")


def _describe_answer(answer: ScoredAnswer) -> str:
    degree = f" ({answer.degree:.2f})" if answer.degree == answer.degree else ""
    said = f"{answer.said or '–'}{degree}"
    return said if answer.is_right else f"{said}, right is {answer.right}"


# --- lists ---------------------------------------------------------------------------

_HEADS = ("dialogue", "right", "of", "turns", "words", "corrections", "lessons")


def _dialogue_lists(
    name: str, dialogues: Sequence[ScoredDialogue], places: Places
) -> Iterator[Markup]:
    """The dialogues of a theory, tutor by tutor and scene by scene."""
    yield element("p", link("all answers", _beside(places.answers(name))))
    for what in ("tutor", "scene"):
        for one, number in places.numbers[what].items():
            those = [it for it in dialogues if getattr(it.run, what) == one]
            yield element("h3", f"{what} {one}", id=f"{what}-{number}")
            yield _linked_rows(_HEADS, those, map(_counts, those), places)


def _counts(it: ScoredDialogue) -> tuple[Cell, ...]:
    return (
        sum(one.is_right for one in it.answers),
        len(it.answers),
        sum(one.turns for one in it.efforts),
        sum(one.words for one in it.efforts),
        sum(one.corrections for one in it.efforts),
        it.lessons,
    )


def _linked_rows(
    heads: tuple[str, ...],
    dialogues: Sequence[ScoredDialogue],
    rows: Iterable[tuple[Cell, ...]],
    places: Places,
) -> Markup:
    """A table whose rows lead to dialogues."""
    cells = tuple((_title(it), *row) for it, row in zip(dialogues, rows, strict=True))
    links = {
        (row, 0): _beside(places.dialogue(it.run)) for row, it in enumerate(dialogues)
    }
    return table_element(Table("", heads, cells, "", links))


_LINKS = (
    "Each answer by its dialogue and its turn there: 3:80 is turn 80 of dialogue 3."
)

_Given = tuple[ScoredDialogue, ScoredAnswer]


def _answer_lists(
    name: str, dialogues: Sequence[ScoredDialogue], places: Places
) -> Iterator[Markup]:
    """The answers of a theory by kind of word and word, phase, and way of saying."""
    yield element("p", link("all dialogues", _beside(places.theory(name))))
    yield element("p", _LINKS, class_="note")
    given = [(it, answer) for it in dialogues for answer in it.answers]
    for kind, number in places.numbers["kind"].items():
        of_kind = [it for it in given if it[1].kind == kind]
        yield element("h2", kind, id=f"kind-{number}")
        for (of, word), place in places.numbers["word"].items():
            if of == kind:
                some = [it for it in of_kind if it[1].right == word]
                yield element("h3", word, id=f"word-{place}")
                yield _answer_table(some, places)
    yield from _answers_by("phase", "in", given, places)
    yield from _answers_by("way", "as", given, places)


def _answers_by(
    what: str, preposition: str, given: Sequence[_Given], places: Places
) -> Iterator[Markup]:
    for one, number in places.numbers[what].items():
        some = [it for it in given if getattr(it[1], what) == one]
        if some:
            yield element("h2", f"{preposition} {one}", id=f"{what}-{number}")
            yield _answer_table(some, places)


def _answer_table(given: Sequence[_Given], places: Places) -> Markup:
    """Answers by what was right and what was said, each a link to its turn."""
    groups: dict[tuple[str, str], list[_Given]] = {}
    for it in given:
        groups.setdefault((it[1].right, it[1].said), []).append(it)
    rows = (
        (
            element("td", _mark(them[0][1])),
            element("td", right),
            element("td", said or "–"),
            element("td", str(len(them)), class_="number"),
            element("td", join(_turn_link(*it, places) for it in them), class_="links"),
        )
        for (right, said), them in sorted(groups.items())
    )
    heads = (
        element("th", head, class_="number" if head == "times" else "")
        for head in ("", "right", "said", "times", "")
    )
    return scrolling_table(heads, rows)


def _turn_link(
    dialogue: ScoredDialogue, answer: ScoredAnswer, places: Places
) -> Markup:
    text = f"{places.pairs[dialogue.pair]}:{answer.turn}"
    return link(text, _beside(places.turn(dialogue.run, answer.turn)))


def _differences(
    one: Sequence[ScoredDialogue], other: Sequence[ScoredDialogue], places: Places
) -> Iterator[Markup]:
    """The dialogues in which two theories differ most come first."""
    rows = []
    for first, second in in_pairs(one, other):
        before, after = value(ACCURACY, [first]), value(ACCURACY, [second])
        rows.append((before, after, after - before, first))
    rows.sort(key=lambda it: (it[2] != it[2], -abs(it[2]), it[3].pair))
    heads = ("dialogue", one[0].run.theory, other[0].run.theory, "difference")
    yield element(
        "p", "Accuracy in each pair of dialogues, the largest difference first."
    )
    yield _linked_rows(heads, [it[3] for it in rows], (it[:3] for it in rows), places)
