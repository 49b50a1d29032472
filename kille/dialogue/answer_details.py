"""The details of an answer in words: degrees, reasons, times and counts.

A move has them as they are: numbers, names of cues, a lesson and its age. The lexicon
says how they are worded. Which wording of the move is used depends on the slots that
can be filled: without a lesson there is nothing for {when}.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from typing import Any

from kille.dialogue.lexicon import Lexicon
from ttr import Record, record

Section = Mapping[str, Any]

_DAY = 24 * 60 * 60


def details(lexicon: Lexicon, move: Record) -> dict[str, str]:
    """The slots that a move fills besides those of its content and its rival.

    >>> from kille.dialogue.lexicon import lexicon
    >>> from ttr import record
    >>> nothing = ("reasons", "recalls", "recalled", "lost", "undone")
    >>> details(lexicon(), record(dict.fromkeys(nothing, ()), degrees=[0.87, 0.08]))
    {'degree': '.87', 'sureness': 'quite sure', 'rival_degree': '.08',
     'distance': 'far behind'}
    """
    if "degrees" not in move:
        return {}
    data = lexicon.sections
    slots = dict(_of_degrees(data, move.degrees)) if move.degrees else {}
    slots |= dict(_of_reasons(data, move.reasons)) if move.reasons else {}
    slots |= dict(_of_lost(data, move.lost)) if move.lost else {}
    for reminder in (*move.undone, *(move.cited if "cited" in move else ())):
        slots |= {
            "lesson": _lesson_text(reminder),
            "when": _when(data["ages"], reminder),
        }
    if "measured" in move:
        slots |= dict(_of_measured(data, move.measured))
    if move.recalls:
        recalled = move.recalled or _without_recall(move.recalls)
        slots |= dict(_of_recalled(lexicon, recalled))
        slots["type"] = str(move.content)
    return slots


# --- degrees -------------------------------------------------------------------------


def _of_degrees(data: Section, degrees: Sequence[float]) -> Iterator[tuple[str, str]]:
    yield "degree", _number(data, degrees[0])
    yield "sureness", _band(data["sureness"], degrees[0])
    for rival in degrees[1:]:
        yield "rival_degree", _number(data, rival)
        yield "distance", _band(data["distance"], degrees[0] - rival)


def _number(data: Section, degree: float) -> str:
    """A degree with two digits: .87, in the language's way to write it."""
    whole, digits = f"{degree:.2f}".split(".")
    return f"{whole.lstrip('0')}{data['knows']['point']}{digits}"


def _band(bands: Mapping[str, float], degree: float) -> str:
    """The words for the highest band that a degree reaches, or for the lowest."""
    reached = (words for words, least in bands.items() if degree >= least)
    return next(reached, list(bands)[-1])


# --- sizes ---------------------------------------------------------------------------


def _of_measured(
    data: Section, measured: Sequence[Record]
) -> Iterator[tuple[str, str]]:
    """What was measured of a thing, and of the one that it is compared with."""
    for rival, it in zip(("", "rival_"), measured, strict=False):
        yield f"{rival}height", _metric(data, it.height)
        yield f"{rival}length", _metric(data, it.length)
        yield f"{rival}distance_away", _metric(data, it.distance)


def _metric(data: Section, metres: float) -> str:
    """A length in centimetres, or from one metre on in metres with one digit."""
    if metres < 0.995:
        return f"{max(1, round(100 * metres))} cm"
    return f"{metres:.1f} m".replace(".", data["knows"]["point"])


# --- reasons -------------------------------------------------------------------------


def _of_reasons(data: Section, reasons: Sequence[Record]) -> Iterator[tuple[str, str]]:
    [reason] = reasons
    cues = list(deciding_cues(data, reason.cues))
    if cues:
        yield "cues", _join_words(data, cues)
    for reminder in reason.reminders:
        yield "lesson", _lesson_text(reminder)
        yield "turn", reminder.turn
        yield "when", _when(data["ages"], reminder)


def _lesson_text(reminder: Record) -> str:
    """The words of a lesson."""
    return str(reminder.text).rstrip()


def deciding_cues(data: Section, cues: Iterable[Record]) -> Iterator[str]:
    """What the cues that decided are called, the most important first."""
    reasons, explained = data["reasons"], 0.0
    for name, share in islice(_named_shares(data, cues), reasons["most"]):
        if explained < reasons["enough"]:
            yield name
        explained += share


def cue_shares(lexicon: Lexicon, reason: Record) -> Mapping[str, float]:
    """How much each cue counted in a reason, by what it is called, the most first.

    >>> from kille.dialogue.lexicon import lexicon
    >>> cues = [record(name="hue", share=0.75), record(name="size", share=0.25)]
    >>> cue_shares(lexicon("sv"), record(cues=cues))
    {'färgen': 0.75, 'storleken': 0.25}
    """
    return dict(_named_shares(lexicon.sections, reason.cues))


def _named_shares(data: Section, cues: Iterable[Record]) -> Iterator[tuple[str, float]]:
    """The names of cues with their shares, the most important first."""
    shares: dict[str, float] = {}
    for cue in cues:
        name = data["cues"].get(cue.name, cue.name)
        shares[name] = shares.get(name, 0.0) + cue.share
    yield from sorted(shares.items(), key=lambda it: -it[1])


def _when(ages: Section, reminder: Record) -> str:
    """How long ago a lesson was, or on which day and when."""
    for age in ages["recent"]:
        if reminder.age < age["below"]:
            count = int(reminder.age // age.get("unit", 1))
            return str(age["says"]).format(n=count)
    hours, minutes = map(int, reminder.time.split(":"))
    days = int((hours * 60 + minutes) * 60 + reminder.age) // _DAY
    wording = ages["days"][days] if days < len(ages["days"]) else ages["earlier"]
    return str(wording).format(day=reminder.day, time=reminder.time)


# --- words ---------------------------------------------------------------------------


def _of_recalled(
    lexicon: Lexicon, recalled: Sequence[Record]
) -> Iterator[tuple[str, str]]:
    data = lexicon.sections
    knows = data["knows"]
    most = knows["most"]
    ordered = sorted(recalled, key=lambda it: (-it.lessons, it.sign.form))
    words = [_word_with_count(knows, it) for it in ordered[:most]]
    if len(ordered) > most:
        words.append(knows["rest"].format(n=len(ordered) - most))
    yield "words", _join_words(data, words)
    if recalled[0].lessons:
        yield "lessons", _lessons(knows, recalled[0].lessons)
        yield "times", _often(data, recalled[0].lessons)
    if recalled[0].lessons > 1:
        yield "several_times", _often(data, recalled[0].lessons)
    for reminder in recalled[0].reminders:
        yield "lesson", _lesson_text(reminder)
        yield "when", _when(data["ages"], reminder)
    if recalled[0].qualities:
        one, often = knows["qualities"]
        forms = [lexicon.predicative_form(it.form, "") for it in recalled[0].qualities]
        wording = one if recalled[0].lessons == 1 else often
        yield "qualities", wording.format(_join_words(data, forms))
    if recalled[0].confused:
        confused = [f'"{it.form}"' for it in recalled[0].confused]
        yield "confused", _join_words(data, confused)


def _without_recall(words: Iterable[Record]) -> list[Record]:
    """Records of words of which nothing was recalled."""
    nothing: dict[str, object] = dict.fromkeys(
        ("confused", "qualities", "reminders"), ()
    )
    return [record(nothing, sign=word, lessons=0.0) for word in words]


def _word_with_count(knows: Section, recalled: Record) -> str:
    """A word with the number of its lessons, if there are any."""
    form = str(recalled.sign.form)
    if not recalled.lessons:
        return form
    lessons = _lessons(knows, recalled.lessons)
    return str(knows["word"].format(word=form, lessons=lessons))


def _often(data: Section, count: float) -> str:
    """How often something was: once, twice, three times."""
    wordings = data["knows"]["often"]
    numbers = data["listing"]["numbers"]
    n = int(count)
    number = numbers[n - 1] if n <= len(numbers) else str(n)
    return str(wordings[min(n, len(wordings)) - 1]).format(n=number)


def _lessons(knows: Section, count: float) -> str:
    return str(knows["one" if count == 1 else "many"].format(n=int(count)))


def _of_lost(data: Section, lost: Sequence[Record]) -> Iterator[tuple[str, str]]:
    yield "lost", _join_words(data, [f'"{sign.form}"' for sign in lost])


def _join_words(data: Section, words: Sequence[str]) -> str:
    """Words as a list: this, that and the other."""
    *before, last = words
    return str(data["knows"]["and"]).join(filter(None, (", ".join(before), last)))
