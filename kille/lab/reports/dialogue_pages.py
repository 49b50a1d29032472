"""Pages of dialogues: what was said, by all theories side by side, and where to look.

Each number of a report leads to one of them. They need nothing but the report's folder.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations, cycle

from kille.lab.dialogues import Turn
from kille.lab.measures.comparison import in_pairs
from kille.lab.measures.measures import ACCURACY, value
from kille.lab.measures.scored_dialogues import ScoredAnswer, ScoredDialogue
from kille.lab.reports.events import happening
from kille.lab.reports.figure_styles import HUES
from kille.lab.reports.findings import Theories
from kille.lab.reports.links import Places
from kille.lab.reports.result_pages import beginning
from kille.lab.reports.styles import DIALOGUES, THEORIES
from ttr.escapes import html_address, html_text

Page = tuple[str, str]
"""The name of a file, and what is in it."""

_Piece = tuple[str, str, Iterable[str]]


def pages(theories: Theories, places: Places, report: str) -> Iterator[Page]:
    """All pages, each with the name of its file in the folder of the places.

    `report` is the name of the page that leads to them, a folder further out.
    """
    for name, title, body in _pages(theories, places):
        back = f'<p><a href="../{html_address(report)}">report</a></p>'
        parts = (*beginning(title, THEORIES + DIALOGUES), back, *body, "</body></html>")
        yield _file(name), "\n".join(parts) + "\n"


def _pages(theories: Theories, places: Places) -> Iterator[_Piece]:
    """The place, the title and the body of each."""
    occasions: dict[tuple[str, str, int], list[ScoredDialogue]] = {}
    for them in theories.values():
        for it in them:
            occasions.setdefault(it.pair, []).append(it)
    for them in occasions.values():
        title = f"Dialogue {places.pairs[them[0].pair]}: {_title(them[0])}"
        yield places.dialogue(them[0].run), title, _said(them, places)
    for name, them in theories.items():
        yield places.theory(name), name, _dialogues(name, them, places)
        title = f"{name}: all answers"
        yield places.answers(name), title, _answers(name, them, places)
    for one, other in combinations(theories, 2):
        title = f"{other} against {one}"
        body = _against(theories[one], theories[other], places)
        yield places.against(one, other), title, body


def _file(place: str) -> str:
    """The name of the file of a place."""
    return place.partition("#")[0].rpartition("/")[2]


def _beside(place: str) -> str:
    """A place as seen from another page."""
    return place.rpartition("/")[2]


def _title(dialogue: ScoredDialogue) -> str:
    tutor, scene, seed = dialogue.pair
    return f"{tutor}, {scene}, seed {seed}"


def _link(place: str, text: str) -> str:
    return f'<a href="{html_text(_beside(place))}">{html_text(text)}</a>'


# --- what was said -------------------------------------------------------------------


def _said(dialogues: Sequence[ScoredDialogue], places: Places) -> Iterator[str]:
    """What each theory was told and said: phase by phase, each from the same height."""
    hues = dict(zip(places.theories, cycle(HUES), strict=False))
    yield '<div class="theories">'
    for it in dialogues:
        name = it.run.theory
        yield f'<div id="{_anchor(it, places)}" style="--hue: {hues[name]}">'
        yield f"<h4>{_link(places.theory(name), name)}</h4>"
        yield f'<p class="note">{html_text(_summary(it))}</p></div>'
    yield "</div>"
    for phase in dict.fromkeys(turn.phase for it in dialogues for turn in it.turns):
        yield f'<h3>{html_text(phase)}</h3><div class="theories">'
        for it in dialogues:
            name = it.run.theory
            yield f'<div style="--hue: {hues[name]}">'
            if len(dialogues) > 1:
                yield f'<p class="called">{html_text(name)}</p>'
            yield from _turns(it, phase, f"{_anchor(it, places)}-turn")
            yield "</div>"
        yield "</div>"


def _anchor(dialogue: ScoredDialogue, places: Places) -> str:
    return f"theory-{places.theories[dialogue.run.theory]}"


def _summary(dialogue: ScoredDialogue) -> str:
    right = sum(it.is_right for it in dialogue.answers)
    turns = sum(it.turns for it in dialogue.efforts)
    words = sum(it.words for it in dialogue.efforts)
    return (
        f"{right} of {len(dialogue.answers)} right, {dialogue.lessons} lessons kept, "
        f"{turns} turns and {words} words of the tutor"
    )


def _turns(dialogue: ScoredDialogue, phase: str, anchor: str) -> Iterator[str]:
    answers: dict[int, list[ScoredAnswer]] = {}
    for answer in dialogue.answers:
        answers.setdefault(answer.turn, []).append(answer)
    several = len({turn.tutor for turn in dialogue.turns}) > 1
    for turn in dialogue.turns:
        if turn.phase == phase:
            who = turn.tutor if several else ""
            told = answers.get(turn.number, ())
            yield _turn(turn, who, told, f"{anchor}-{turn.number}")


def _turn(turn: Turn, who: str, answers: Sequence[ScoredAnswer], anchor: str) -> str:
    """A turn; who of several tutors speaks in it is said."""
    lines = [_given(turn, who)] if turn.given else []
    if turn.answer:
        lines.append(f'<p class="robot">{html_text(turn.answer)}</p>')
    lines += [f"<p>{_mark(it)} {html_text(_told(it))}</p>" for it in answers]
    told = f"<span>{turn.number}</span>"
    return f'<div class="turn" id="{anchor}">{told}{"".join(lines)}</div>'


def _given(turn: Turn, who: str) -> str:
    if not turn.words:
        return f'<p class="happens">{html_text(happening(turn.given))}</p>'
    named = f'<span class="who">{html_text(who)}:</span> ' if who else ""
    return f"<p>{named}{html_text(turn.given)}</p>"


def _mark(answer: ScoredAnswer) -> str:
    return (
        '<span class="yes">✓</span>' if answer.is_right else '<span class="no">✗</span>'
    )


def _told(answer: ScoredAnswer) -> str:
    degree = f" ({answer.degree:.2f})" if answer.degree == answer.degree else ""
    said = f"{answer.said or '–'}{degree}"
    return said if answer.is_right else f"{said}, right is {answer.right}"


# --- lists ---------------------------------------------------------------------------

_HEADS = ("dialogue", "right", "of", "turns", "words", "corrections", "lessons")


def _dialogues(
    name: str, dialogues: Sequence[ScoredDialogue], places: Places
) -> Iterator[str]:
    yield f"<p>{_link(places.answers(name), 'all answers')}</p>"
    for tutor, number in places.tutors.items():
        found = [it for it in dialogues if it.run.tutor == tutor]
        yield f'<h3 id="tutor-{number}">tutor {html_text(tutor)}</h3>'
        yield from _table(_HEADS, (_row(it, places) for it in found))
    for scene, number in places.scenes.items():
        found = [it for it in dialogues if it.run.scene == scene]
        yield f'<h3 id="scene-{number}">scene {html_text(scene)}</h3>'
        yield from _table(_HEADS, (_row(it, places) for it in found))


def _row(it: ScoredDialogue, places: Places) -> tuple[str, ...]:
    return (
        _link(places.dialogue(it.run), _title(it)),
        str(sum(one.is_right for one in it.answers)),
        str(len(it.answers)),
        str(sum(one.turns for one in it.efforts)),
        str(sum(one.words for one in it.efforts)),
        str(sum(one.corrections for one in it.efforts)),
        str(it.lessons),
    )


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    """Cells are pieces of a page already; all but the first are numbers."""
    yield '<div class="scroll"><table><thead><tr>'
    yield _cells("th", [html_text(head) for head in heads])
    yield "</tr></thead><tbody>"
    for row in rows:
        yield f"<tr>{_cells('td', row)}</tr>"
    yield "</tbody></table></div>"


def _cells(tag: str, cells: Sequence[str]) -> str:
    first, *others = cells
    return f"<{tag}>{first}</{tag}>" + "".join(
        f'<{tag} class="number">{it}</{tag}>' for it in others
    )


_LINKS = (
    "Each answer by its dialogue and its turn there: 3:80 is turn 80 of dialogue 3."
)

_Given = tuple[ScoredDialogue, ScoredAnswer]


def _answers(
    name: str, dialogues: Sequence[ScoredDialogue], places: Places
) -> Iterator[str]:
    """The answers by kind of word and by word, then by phase."""
    yield f"<p>{_link(places.theory(name), 'all dialogues')}</p>"
    yield f'<p class="note">{_LINKS}</p>'
    given = [(it, answer) for it in dialogues for answer in it.answers]
    for kind, number in places.kinds.items():
        of_kind = [it for it in given if it[1].kind == kind]
        yield f'<h2 id="kind-{number}">{html_text(kind)}</h2>'
        for (its, word), place in places.words.items():
            if its != kind:
                continue
            found = [it for it in of_kind if it[1].right == word]
            yield f'<h3 id="word-{place}">{html_text(word)}</h3>'
            yield from _grouped(found, places)
    for phase, number in places.phases.items():
        found = [it for it in given if it[1].phase == phase]
        if found:
            yield f'<h2 id="phase-{number}">in {html_text(phase)}</h2>'
            yield from _grouped(found, places)
    for way, number in places.ways.items():
        found = [it for it in given if it[1].way == way]
        if found:
            yield f'<h2 id="way-{number}">as {html_text(way)}</h2>'
            yield from _grouped(found, places)


def _grouped(given: Sequence[_Given], places: Places) -> Iterator[str]:
    """Answers by what was right and what was said, each a link to its turn."""
    groups: dict[tuple[str, str], list[_Given]] = {}
    for it in given:
        groups.setdefault((it[1].right, it[1].said), []).append(it)
    yield '<div class="scroll"><table><thead><tr><th></th><th>right</th>'
    yield '<th>said</th><th class="number">times</th><th></th></tr></thead><tbody>'
    for (right, said), them in sorted(groups.items()):
        links = "".join(_to_turn(it, answer, places) for it, answer in them)
        yield (
            f"<tr><td>{_mark(them[0][1])}</td><td>{html_text(right)}</td>"
            f'<td>{html_text(said or "–")}</td><td class="number">{len(them)}</td>'
            f'<td class="links">{links}</td></tr>'
        )
    yield "</tbody></table></div>"


def _to_turn(dialogue: ScoredDialogue, answer: ScoredAnswer, places: Places) -> str:
    place = _beside(places.turn(dialogue.run, answer.turn))
    return f'<a href="{place}">{places.pairs[dialogue.pair]}:{answer.turn}</a>'


def _against(
    one: Sequence[ScoredDialogue], other: Sequence[ScoredDialogue], places: Places
) -> Iterator[str]:
    """The dialogues in which they differ most come first."""
    rows = []
    for first, second in in_pairs(one, other):
        before, after = value(ACCURACY, [first]), value(ACCURACY, [second])
        rows.append((after - before, before, after, first))
    rows.sort(key=lambda it: (it[0] != it[0], -abs(it[0]), it[3].pair))
    heads = ("dialogue", one[0].run.theory, other[0].run.theory, "difference")
    yield "<p>Accuracy in each pair of dialogues, the largest difference first.</p>"
    yield from _table(
        heads,
        (
            (
                _link(places.dialogue(it.run), _title(it)),
                *(f"{x:.3f}" if x == x else "–" for x in (before, after, apart)),
            )
            for apart, before, after, it in rows
        ),
    )
