"""A mug is a kind of cup: the tutor says that one kind of thing is a kind of another.

That is an axiom, mug(x, look) <: cup(x, look): whatever the robot takes for a mug is a
cup from then on. "Tin is another word for can." is two, one in each direction. Where
it does not know one of the nouns it asks first if that is meant, and several kinds it
takes in together. What would make two kinds one, though nobody called the nouns
synonyms, it does not learn; where it was told of a mug that it is not a cup, it asks
which is so. "Forget that." or "No." takes the axiom back.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from kille.dialogue.beliefs import knows, knows_word
from kille.dialogue.commitments import kind_of
from kille.dialogue.games.contradicting import plan_earlier_question
from kille.dialogue.games.doubting_words import MEANT, MEANT_TOO
from kille.dialogue.language import OUTRIGHT
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    is_denial,
    predicate_at,
    set_to,
    value_at,
)
from kille.dialogue.moves import content_of, issue, nouns_said, plan
from kille.dialogue.reference import phrase_at, thing_at
from kille.dialogue.rules import rule
from kille.dialogue.taxonomy import (
    LOWER,
    SYNONYM,
    are_synonyms,
    is_kind_of,
    nouns_in,
    single_kinds,
    subsumption,
    subsumptions_in,
    synonymy,
)
from ttr import Record, RecordType, record, replace
from ttr.updates import first

STILL = "AskKindStill"
"""The question whether it is a kind of the other, though a lesson says otherwise."""

VETTED = "vetted"
"""The label that a move has of which the tutor has said that all of it is meant."""

CLASSIFYING = ("Classify", "Equate")
"""The moves that say of a kind what it is a kind of, or what else it is called."""

TOLD = (
    "learned_kind",
    "know_kind",
    "cite_kind",
    "explain_kind",
    "same_kind",
    "learned_synonym",
    "know_synonym",
)
"""What the robot says of an axiom, which "Forget that." may take back."""


# --- teaching -------------------------------------------------------------------------


@rule(answers=CLASSIFYING)
def take_kinds_together(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is said of several kinds at once: it takes in all, or asks about all."""
    said = s.shared.latest
    singles = [replace(said, content=it) for it in single_kinds(said.content)]
    if len(singles) < 2:
        return None
    singles.sort(key=lambda it: said.signs.index(nouns_in(it.content, said.signs)[0]))
    nouns = [_nouns(replace(s, {"shared.latest": it})) for it in singles]
    for lower, upper in nouns:
        if not (knows_word(s, lower) or knows_word(s, upper)):
            return _plan_answer(s, "NeedKind", lower, upper, types=types)
    known = all(knows_word(s, sign) for two in nouns for sign in two)
    if not (known or _is_meant(said)):
        return _plan_question(s, singles, types=types)
    learned = s
    for it in singles:
        learned = plan_kind(replace(learned, {"shared.latest": it}), types=types)
    return learned


@rule(answers=CLASSIFYING)
def know_kind(s: Record, *, types: DialogueTypes) -> Record | None:
    """That the one is a kind of the other was taught, or follows from what was."""
    return _plan_known(s, types=types)


@rule(answers=CLASSIFYING)
def refuse_same(s: Record, *, types: DialogueTypes) -> Record | None:
    """It would make two kinds one: it says that the reverse was taught."""
    return _plan_refusal(s, types=types)


@rule(answers=CLASSIFYING)
def need_kind(s: Record, *, types: DialogueTypes) -> Record | None:
    """It knows neither of the two nouns: it asks to be shown one of them first."""
    lower, upper = _nouns(s)
    if knows_word(s, lower) or knows_word(s, upper):
        return None
    return _plan_answer(s, "NeedKind", lower, upper, types=types)


@rule(answers=CLASSIFYING)
def ask_new_kind(s: Record, *, types: DialogueTypes) -> Record | None:
    """It does not know one of the nouns: it asks whether all of it is meant.

    Who says "a kind of" in so many words means it, if the new noun is a common one.
    """
    said = s.shared.latest
    if _is_meant(said) or all(knows_word(s, sign) for sign in _nouns(s)):
        return None
    return _plan_question(s, [said], types=types)


@rule(answers=CLASSIFYING)
def ask_still(s: Record, *, types: DialogueTypes) -> Record | None:
    """Something here was said to be the one and not the other: it asks which is so."""
    return _plan_still(s, types=types)


@rule(answers=CLASSIFYING)
def learn_kind(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor says that the one is a kind of the other: that is an axiom now."""
    return _plan_axiom(s, types=types)


@rule(answers="Affirm")
def learn_still(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is a kind of the other: what was said against it is unlearned."""
    if not _asks_still(s):
        return None
    asked, *rest = s.shared.qud
    said = replace(s, {"shared.qud": rest, "shared.latest": asked.options[0]})
    against = [it.key for two in _directions(said) for it in _exceptions(said, *two)]
    return _plan_axiom(said, forgets=against, types=types)


@rule(answers=("Deny", "ForgetThat", "ForgetLast"))
def leave_kind(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is no kind of the other: nothing is learned from that."""
    if not _asks_still(s) or kind_of(content_of(s)) is not None:
        return None
    return plan(replace(s, {"shared.qud": s.shared.qud[1:]}), "LetBe", types=types)


# --- asking ---------------------------------------------------------------------------


@rule(answers="AskSubkind")
def tell_kind(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor asks if the one is a kind of the other: only axioms say so."""
    lower, upper = _nouns(s)
    act = "KnowKind" if is_kind_of(s, lower, upper) else "UnknownKind"
    return _plan_answer(s, act, lower, upper, types=types)


@rule(answers="AskWhy")
def cite_kind(s: Record, *, types: DialogueTypes) -> Record | None:
    """It has just said that the one is a kind of the other: the tutor said so."""
    told = _axiom_told(s) if kind_of(content_of(s)) is None else None
    if told is None:
        return None
    return plan(s, "CiteKind", told.content, signs=told.signs, types=types)


# --- taking back ----------------------------------------------------------------------


@rule(answers="Unclassify")
def ask_earlier_kind(s: Record, *, types: DialogueTypes) -> Record | None:
    """In another dialogue the tutor said that it is a kind of the other: it asks."""
    then = _axiom(s, *_nouns(s))
    if then is None or then.after >= 0.0:
        return None
    return plan_earlier_question(s, s.shared.latest, then, types=types)


@rule(answers="Reject")
def ask_denied_kind(s: Record, *, types: DialogueTypes) -> Record | None:
    """What is called by one noun is said not to be what that is a kind of."""
    content, said = content_of(s), s.shared.latest
    if not s.private.kinds or kind_of(content) != "c" or "target" not in content:
        return None
    upper = next((it for it in said.signs if claims(content, it)), None)
    for lower in nouns_said(said, phrase_at(content, "target")):
        then = None if upper is None else _axiom(s, lower, upper)
        if then is not None and then.after < 0.0:
            return plan_earlier_question(s, said, then, types=types)
    return None


@rule(answers=("Unclassify", "ForgetKind"))
def forget_kind(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor says that it is no kind of the other: the axiom is taken back."""
    lower, upper = _nouns(s)
    then = _axiom(s, lower, upper)
    if then is not None:
        return _plan_forgetting(s, then, types=types)
    if is_kind_of(s, lower, upper):
        return _plan_answer(s, "KnowKind", lower, upper, types=types)
    return _plan_answer(s, "UnknownKind", lower, upper, types=types)


@rule(answers="Deny")
def take_kind_back(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor rejects what the robot has just said of two kinds: it is taken back."""
    return _plan_taking_back(s, types=types)


@rule(answers="ForgetThat")
def forget_that_kind(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor has the robot forget what it has just said of two kinds."""
    return _plan_taking_back(s, types=types)


def _plan_taking_back(s: Record, *, types: DialogueTypes) -> Record | None:
    """The plan to take back the axiom that the robot has just spoken of, if it has."""
    told = _axiom_told(s) if kind_of(content_of(s)) is None else None
    return None if told is None else _plan_forgetting(s, told, types=types)


def _axiom_told(s: Record) -> Record | None:
    """The axiom that the robot has just spoken of, if it has."""
    if not s.private.kinds or len(s.private.last) != 1:
        return None
    said = s.private.last[0]
    if s.shared.pending or predicate_at(said, "e").name not in TOLD:
        return None
    told = value_at(said, "content")
    assert isinstance(told, RecordType)
    [first, *_] = subsumptions_in(told, value_at(said, "signs"))
    return next((it for it in s.private.kinds if it.content == first), None)


@rule(answers="ForgetLast")
def forget_last_kind(s: Record, *, types: DialogueTypes) -> Record | None:
    """An axiom is the latest that was taught in this dialogue."""
    own = [it for it in s.private.kinds if it.after >= 0.0]
    if not own or own[-1].after < len(s.private.lessons):
        return None
    return _plan_forgetting(s, own[-1], types=types)


# --- objecting ------------------------------------------------------------------------


@rule(answers="Instruct")
def object_to_name(s: Record, *, types: DialogueTypes) -> Record | None:
    """A thing is said to be one kind, and was said not to be what that is a kind of."""
    return plan_objection(s, types=types)


@rule(answers="Reject")
def object_to_denial(s: Record, *, types: DialogueTypes) -> Record | None:
    """A thing is said not to be of a kind, and was said to be of a kind of that."""
    return plan_objection(s, types=types)


def plan_objection(s: Record, *, types: DialogueTypes) -> Record | None:
    """The plan to say which axiom and which lesson the latest move is against."""
    content = content_of(s)
    for lower, upper, told in _conflicts(s, content):
        said = set_to(told.content, **dict(subsumption(lower, upper).fields))
        signs = (told.sign, lower, upper)
        return plan(s, "ObjectKind", said, signs=signs, types=types)
    return None


def is_about_kinds(content: RecordType) -> bool:
    """Whether a content says of kinds which is one of which, or what means the same."""
    return LOWER in content or SYNONYM in content


def plan_kind(s: Record, *, types: DialogueTypes) -> Record:
    """The plan to learn what the latest move says of two kinds, or to say why not."""
    for find in (_plan_known, _plan_refusal, _plan_still):
        answered = find(s, types=types)
        if answered is not None:
            return answered
    return _plan_axiom(s, types=types)


def _plan_known(s: Record, *, types: DialogueTypes) -> Record | None:
    """The plan to say that it knows this, if it does."""
    lower, upper = _nouns(s)
    if knows([lower], upper):
        return None
    if SYNONYM in content_of(s):
        known = are_synonyms(s, lower, upper)
        act, content = "KnowSynonym", synonymy(lower, upper)
    else:
        known = is_kind_of(s, lower, upper)
        act, content = "KnowKind", subsumption(lower, upper)
    return plan(s, act, content, signs=[lower, upper], types=types) if known else None


def _plan_refusal(s: Record, *, types: DialogueTypes) -> Record | None:
    """The plan to say why two kinds cannot be so related, if they cannot."""
    lower, upper = _nouns(s)
    if knows([lower], upper):
        return plan(s, "SameThing", types=types)
    for one, other in _directions(s):
        if is_kind_of(s, other, one):
            return _plan_answer(s, "SameKind", other, one, types=types)
    return None


def _plan_still(s: Record, *, types: DialogueTypes) -> Record | None:
    """The plan to ask if it is so though a lesson says otherwise, if one does."""
    for lower, upper in _directions(s):
        if any(_exceptions(s, lower, upper)):
            asked = issue(STILL, [s.shared.latest])
            return _plan_answer(s, STILL, lower, upper, asks=[asked], types=types)
    return None


def _plan_question(
    s: Record, meant: Sequence[Record], *, types: DialogueTypes
) -> Record:
    """The plan to ask whether the tutor means what these moves say of kinds."""
    options = [
        record({**{label: it[label] for label in it}, VETTED: "yes"}) for it in meant
    ]
    for n, it in enumerate(options):
        s = plan(
            s,
            MEANT_TOO if n else MEANT,
            it.content,
            signs=nouns_in(it.content, it.signs),
            asks=() if n else [issue(MEANT, options)],
            types=types,
        )
    return s


def _is_meant(said: Record) -> bool:
    """Whether the tutor has said so in so many words, or when asked."""
    return VETTED in said or ("stance" in said and said.stance == OUTRIGHT)


def _directions(s: Record) -> list[tuple[Record, Record]]:
    """Of which kind which is said to be one: for synonyms, each of the other."""
    lower, upper = _nouns(s)
    both = [(lower, upper), (upper, lower)]
    return both if SYNONYM in content_of(s) else both[:1]


def _nouns(s: Record) -> tuple[Record, Record]:
    """The two nouns of the latest move: of which kind which is one, or synonyms."""
    lower, upper = nouns_in(content_of(s), s.shared.latest.signs)
    return lower, upper


def _axiom(s: Record, lower: Record, upper: Record) -> Record | None:
    """What was taught of just these two kinds, if it was."""
    said = subsumption(lower, upper)
    return next((it for it in s.private.kinds if it.content == said), None)


def _asks_still(s: Record) -> bool:
    """Whether the question under discussion is if it is so all the same."""
    return bool(s.shared.qud) and s.shared.qud[0].ask == STILL


def _plan_answer(
    s: Record,
    act: str,
    lower: Record,
    upper: Record,
    *,
    asks: Sequence[Record] = (),
    types: DialogueTypes,
) -> Record:
    """The plan to say this of two kinds."""
    content = subsumption(lower, upper)
    return plan(s, act, content, signs=[lower, upper], asks=asks, types=types)


def _plan_axiom(
    s: Record, *, forgets: Sequence[str] = (), types: DialogueTypes
) -> Record:
    """The plan to learn that the one kind is a kind of the other, or means the same."""
    content, said = content_of(s), s.shared.latest
    told = subsumptions_in(content, said.signs)
    return plan(
        s,
        "LearnedSynonym" if SYNONYM in content else "LearnedKind",
        content,
        signs=nouns_in(content, said.signs),
        forgets=forgets,
        classifies=told,
        types=types,
    )


def _plan_forgetting(s: Record, kind: Record, *, types: DialogueTypes) -> Record:
    """The plan to take an axiom back; that of synonyms in both directions."""
    lower, upper = kind.signs
    reverse = _axiom(s, upper, lower)
    synonyms = synonymy(lower, upper)
    return plan(
        s,
        "ForgotKind" if reverse is None else "ForgotSynonym",
        kind.content if reverse is None else synonyms,
        signs=kind.signs,
        forgets=[it.key for it in (kind, reverse) if it is not None],
        types=types,
    )


def _exceptions(s: Record, lower: Record, upper: Record) -> Iterator[Record]:
    """The lessons that something in view is no `upper`, though it is a `lower`."""
    names = [it for it in _lessons_here(s) if is_kind_of(s, it.sign, lower)]
    called = {thing_at(it.content, "target") for it in names if _holds(it)}
    for it in _lessons_here(s):
        if _holds(it) or not is_kind_of(s, upper, it.sign):
            continue
        if thing_at(it.content, "target") in called:
            yield it


def _conflicts(
    s: Record, content: RecordType
) -> Iterator[tuple[Record, Record, Record]]:
    """The axioms against a lesson in what something is: two kinds, and what was said.

    What was said is the earlier lesson about the same thing that the axiom speaks of.
    """
    if not s.private.kinds:
        return
    denied, x = is_denial(content), thing_at(content, "target")
    said = next((it for it in s.shared.latest.signs if claims(content, it)), None)
    if said is None or kind_of(content) != "c":
        return
    for it in _lessons_here(s):
        pair = (it.sign, said) if denied else (said, it.sign)
        opposed = _holds(it) is denied and thing_at(it.content, "target") == x
        if opposed and not knows([it.sign], said) and is_kind_of(s, *pair):
            yield (*pair, it)


def _lessons_here(s: Record) -> Iterator[Record]:
    """What the tutor has taught of what the things in view are, or are not."""
    for it in s.private.lessons:
        if kind_of(it.content) == "c" and it.content in s.shared.here:
            yield it


def _holds(lesson: Record) -> bool:
    """Whether a lesson says that its noun is true of its thing."""
    return not is_denial(lesson.content)


KINDS_OF_KINDS = first(
    take_kinds_together,
    know_kind,
    refuse_same,
    need_kind,
    ask_new_kind,
    ask_still,
    learn_kind,
    tell_kind,
    cite_kind,
    ask_earlier_kind,
    ask_denied_kind,
    forget_kind,
    take_kind_back,
    forget_that_kind,
    forget_last_kind,
    object_to_name,
    object_to_denial,
)
STILL_ANSWERED = first(learn_still, leave_kind)
"""What answers whether one kind is a kind of another all the same."""
