"""Several lessons in one breath: the robot asks about all of them, and learns them.

"Cup on the left, book on the right." – "Do you mean that the one on the left is a cup?
And that the one on the right is a book?" One yes teaches both. Where nobody has said
which thing is which, and there are as many as words, they are taken from left to right.
A content has the further claims under the label `also`.
"""

from __future__ import annotations

from collections.abc import Sequence

from kille.dialogue.commitments import knows_places, plan_learning
from kille.dialogue.games.distinguishing import say_where
from kille.dialogue.games.doubting_words import MEANT, MEANT_TOO, PRESUMED
from kille.dialogue.games.kinds_of_kinds import is_about_kinds, plan_kind
from kille.dialogue.games.placing import AMID, plan_between
from kille.dialogue.games.referring import about
from kille.dialogue.meanings import (
    DialogueTypes,
    is_denial,
    set_to,
    single_claims,
)
from kille.dialogue.moves import content_of, issue, plan
from kille.dialogue.reference import (
    across,
    intended_readings,
    phrase_at,
    phrases,
    possible_readings,
    thing_at,
)
from kille.dialogue.rules import rule
from kille.dialogue.word_lists import PARTIAL
from ttr import Model, Record, RecordType, replace
from ttr.updates import first

UNMARKED = {"x", "look", "d"}
"""The labels of a phrase that describes no thing, such as "this"."""


@rule(answers="Doubted")
def ask_together(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor has said several things at once: it asks whether all of it is meant."""
    said = s.shared.latest
    told = single_claims(said.content)
    if said.doubt != PARTIAL or not s.view.things:
        return None
    is_plain = len(s.view.things) > 1 and "intended" not in said
    if len(told) < 2 and not (is_plain and _is_counted_out(told[0])):
        return None
    meant = _set_to_things(s, model, told, types=types)
    if not meant:
        return None
    options = [replace(said, content=it, doubt="") for it in meant]
    asked = s
    for n, content in enumerate(meant):
        again = n > 0 and thing_at(content, "target") == thing_at(meant[0], "target")
        asked = plan(
            asked,
            MEANT_TOO if n else MEANT,
            _claim_with_place(s, model, content, again=again, types=types),
            signs=said.signs,
            asks=() if n else [issue(MEANT, options)],
            types=types,
        )
    return asked


@rule(answers="Affirm")
def learn_together(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor means all of it: all of it is learned."""
    if not s.shared.qud or s.shared.qud[0].ask not in (MEANT, PRESUMED):
        return None
    asked, *rest = s.shared.qud
    if asked.ask == MEANT and len(asked.options) < 2:
        return None
    learned = replace(s, {"shared.qud": rest})
    for option in asked.options:
        now = {"shared.latest": option}
        if is_about_kinds(option.content):
            learned = plan_kind(replace(learned, now), types=types)
            continue
        learned = about(replace(learned, now), option.content, types=types)
        if AMID in option.content:
            learned = plan_between(learned, model, types=types)
        elif knows_places(learned, content_of(learned)):
            learned = plan_learning(learned, content_of(learned), types=types)
        else:
            learned = plan(learned, "NeedDepth", types=types)
    return learned


@rule(answers=("Reversed", "Swap"))
def learn_reversed(s: Record, *, types: DialogueTypes) -> Record | None:
    """Each of two things is what it took the other for: that is learned."""
    if not s.shared.qud or s.shared.qud[0].ask not in (MEANT, PRESUMED):
        return None
    asked, *rest = s.shared.qud
    if len(asked.options) != _PAIR or not all(map(_names_thing, asked.options)):
        return None
    one, other = asked.options
    things = [it.content["target"] for it in (other, one)]
    if thing_at(one.content, "target") == thing_at(other.content, "target"):
        return None
    learned = replace(s, {"shared.qud": rest})
    for option, thing in zip((one, other), things, strict=True):
        content = set_to(option.content, target=thing)
        heard = replace(option, content=content)
        learned = about(
            replace(learned, {"shared.latest": heard}), content, types=types
        )
        learned = plan_learning(learned, content_of(learned), types=types)
    return learned


_PAIR = 2
"""So many things may have been taken for one another."""


def _names_thing(option: Record) -> bool:
    """Whether a move says what a thing in view is, and not how it is or stands."""
    content = option.content
    return "c" in content and thing_at(content, "target") is not None


def _set_to_things(
    s: Record, model: Model, told: Sequence[RecordType], *, types: DialogueTypes
) -> list[RecordType]:
    """The claims, each set to its thing; none if it is open which things are meant."""
    found: list[RecordType] = []
    state = s
    for content in told:
        open_ = possible_readings(state, model, content, types=types)
        meant = intended_readings(state, open_, types=types)
        if phrases(content) and len(meant) != 1:
            break
        found.append(meant[0].content if phrases(content) else content)
        state = about(state, found[-1], types=types)
    things = {thing_at(it, "target") for it in found}
    unmarked = all(_is_unmarked(it) for it in told)
    if len(found) == len(told) and not (unmarked and len(things) < len(s.view.things)):
        return found
    if not unmarked or len(told) != len(s.view.things):
        return found if len(found) == len(told) else []
    in_order = across(s, model, s.view.things, types=types)
    return [
        _set_to_thing(s, it, x, types=types)
        for it, x in zip(told, in_order, strict=True)
    ]


def _is_counted_out(content: RecordType) -> bool:
    """Whether a claim calls its thing the other, the second, the remaining one.

    Which one that is has to be said, before it is learned.
    """
    if not phrases(content) or "target" not in content:
        return False
    phrase = phrase_at(content, "target")
    said = {name for name in _COUNTED if f"{name}(" in str(phrase.get("d"))}
    return bool(said) and not any(label in phrase for label in ("c", "a", "rel"))


_COUNTED = ("other", "remaining", "first", "second", "third", "last", "second_last")
"""The words that say which thing is meant by those that were spoken of, or in a row."""


def _is_unmarked(content: RecordType) -> bool:
    """Whether a claim names its thing, and does not say which one it is."""
    if "c" not in content or is_denial(content) or not phrases(content):
        return False
    if "mentioned" in str(phrase_at(content, "target").get("d")):
        return False  # "or just a jug", of the same thing
    return set(phrase_at(content, "target").labels) <= UNMARKED


def _set_to_thing(
    s: Record, content: RecordType, x: str, *, types: DialogueTypes
) -> RecordType:
    """The claim about a thing, called by nothing."""
    phrase = set_to(types.record_type("Phrase"), x=types["Ind"] @ x)
    look = types["Look"] @ s.view.look
    return set_to(content, look=look, target=set_to(phrase, look=look))


def _claim_with_place(
    s: Record,
    model: Model,
    content: RecordType,
    *,
    again: bool,
    types: DialogueTypes,
) -> RecordType:
    """The claim as the robot asks about it: with the place of its thing."""
    fields = say_where(s, model, content, types=types)
    if fields:
        return set_to(content, **fields)
    if not again:
        return content
    target = phrase_at(types.record_type("Asked"), "target")
    it = set_to(types.record_type("It"), **dict(target.fields))
    return set_to(content, target=it)


SEVERAL_LESSONS = ask_together
LESSONS_ANSWERED = first(learn_together, learn_reversed)
"""What answers whether all of it is meant."""
