"""The colour does not matter: the tutor corrects a reason, and says how things are.

After "Why?" the tutor may say which cue matters for a noun, or does not; it may be said
of a noun at any time: "The colour doesn't matter for cups." What is true of all things
of a kind is said by a generic: "Mugs are white." speaks for a mug where a thing is
white; "Mugs have handles." is kept as it was said, since the robot sees only whole
things. "Forget that." or "No." takes back what was just said. Nothing is learned of
words that are not known.

Source: Park, Lascarides and Ramamoorthy 2025; Rubavicius et al. 2025, for explanations
that a teacher corrects; docs/decisions/087-reasons-can-be-corrected.md.
"""

from __future__ import annotations

from collections.abc import Sequence

from kille.dialogue.beliefs import knows_word
from kille.dialogue.commitments import kind_of
from kille.dialogue.criteria import (
    COMPONENT,
    CUE,
    CUES,
    PROPERTY,
    SUBJECT,
    criteria_about,
    criteria_of,
    degree_of,
    is_against,
    last_subject,
    learned_act,
    sign_at,
    signs_in,
)
from kille.dialogue.games.contradicting import plan_earlier_question
from kille.dialogue.games.explaining import claim_in_question
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    is_denial,
    predicate_at,
    value_at,
)
from kille.dialogue.moves import content_of, plan
from kille.dialogue.reference import things_in
from kille.dialogue.rules import rule
from kille.dialogue.unknown_words import plan_first_unknown
from ttr import Record, RecordType, rectype, replace
from ttr.updates import first

TOLD = (
    "stressed_cue",
    "ignored_cue",
    "learned_generic",
    "know_criterion",
    "cite_generic",
    "cite_cue",
    "cite_ignored_cue",
)
"""What the robot says of a criterion, which "Forget that." and "No." take back."""


# --- teaching -------------------------------------------------------------------------


@rule(answers="WeighCue")
def weigh_claimed(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is said of the noun of the claim that the robot has made or explained."""
    content = content_of(s)
    if SUBJECT in content:
        return None
    noun = claimed_noun(s)
    if noun is None:
        return plan(s, "WhichSubject", content, types=types)
    whole = rectype({**dict(content.fields), SUBJECT: noun.meaning})
    return _plan_criterion(s, whole, [noun], types=types)


@rule(answers=("WeighCue", "Generalise", "AskGeneric"))
def miss_criterion_word(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is said of things, or by a quality, of which the robot knows no word."""
    content = content_of(s)
    said = s.shared.latest.signs
    signs = (sign_at(content, label, said) for label in (SUBJECT, PROPERTY))
    return plan_first_unknown(s, filter(None, signs), types=types)


@rule(answers=("WeighCue", "Generalise"))
def learn_criterion(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor says by what things of a kind are known: that counts from now on."""
    content = content_of(s)
    return _plan_criterion(s, content, s.shared.latest.signs, types=types)


def _plan_criterion(
    s: Record, content: RecordType, signs: Sequence[Record], *, types: DialogueTypes
) -> Record:
    """The plan to learn by what things are known, in place of what was said before."""
    before, used = criteria_about(s, content), signs_in(content, signs)
    if any(it.content == content for it in before):
        return _plan_answer(s, "KnowCriterion", content, used, types=types)
    if _leaves_nothing(s, content, used):
        return _plan_answer(s, "NothingLeft", content, used, types=types)
    earlier = [
        it for it in before if it.after < 0.0 and is_against(it.content, content)
    ]
    if earlier:
        now = replace(s.shared.latest, content=content, signs=used)
        return plan_earlier_question(s, now, earlier[-1], types=types)
    return plan(
        s,
        learned_act(content),
        content,
        signs=used,
        weighs=[content],
        forgets=[it.key for it in before],
        pending=s.shared.pending,
        types=types,
    )


def _leaves_nothing(s: Record, content: RecordType, signs: Sequence[Record]) -> bool:
    """Whether no cue would be left that counts."""
    if CUE not in content or degree_of(content):
        return False
    said = [it.content for it in criteria_of(s, signs[0]) if CUE in it.content]
    ignored = {value_at(it, CUE) for it in said if not degree_of(it)}
    return {*ignored, value_at(content, CUE)} >= {*CUES}


# --- taking back ----------------------------------------------------------------------


@rule(answers="ForgetCriterion")
def forget_criterion(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor has it forget by what things are known."""
    content = content_of(s)
    noun = claimed_noun(s)
    if SUBJECT not in content and noun is not None:
        content = rectype({**dict(content.fields), SUBJECT: noun.meaning})
    for it in criteria_about(s, content)[::-1]:
        return _plan_forgetting(s, it, types=types)
    return plan(s, "ForgetNothing", types=types)


@rule(answers=("Deny", "ForgetThat"))
def take_criterion_back(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor rejects what the robot has just learned of a cue, or of all things."""
    if not s.private.criteria or len(s.private.last) != 1 or s.shared.qud:
        return None
    said = s.private.last[0]
    if kind_of(content_of(s)) is not None or predicate_at(said, "e").name not in TOLD:
        return None
    told, before = value_at(said, "content"), value_at(said, "rival")
    for it in s.private.criteria:
        if it.content == told:
            left = _plan_forgetting(s, it, types=types)
            if not isinstance(before, RecordType) or SUBJECT not in before:
                return left
            return _plan_criterion_again(left, before, it.signs, types=types)
    return None


def _plan_criterion_again(
    s: Record, before: RecordType, signs: Sequence[Record], *, types: DialogueTypes
) -> Record:
    """The plan to learn again what had been replaced by a criterion."""
    used = signs_in(before, signs)
    return plan(
        s,
        learned_act(before),
        before,
        signs=used,
        weighs=[before],
        pending=s.shared.pending,
        types=types,
    )


@rule(answers="ForgetLast")
def forget_last_criterion(s: Record, *, types: DialogueTypes) -> Record | None:
    """A criterion is the latest that was taught in this dialogue."""
    own = [it for it in s.private.criteria if it.after >= 0.0]
    later = [it for it in s.private.kinds if own and it.after > own[-1].after]
    if not own or later or own[-1].after < len(s.private.lessons):
        return None
    return _plan_forgetting(s, own[-1], types=types)


def _plan_forgetting(s: Record, it: Record, *, types: DialogueTypes) -> Record:
    """The plan to forget a criterion; what the robot has claimed it still claims."""
    return plan(
        s,
        "ForgotCriterion",
        it.content,
        signs=it.signs,
        forgets=[it.key],
        pending=s.shared.pending,
        types=types,
    )


# --- parts ----------------------------------------------------------------------------


@rule(answers=("TellPart", "AskPart"))
def see_no_parts(s: Record, *, types: DialogueTypes) -> Record:
    """A thing in view is said to have a part, or asked if it has: it sees no parts."""
    content = content_of(s)
    signs = [it for it in s.shared.latest.signs if it.meaning == content[COMPONENT]]
    return _plan_answer(s, "SeeNoParts", content, signs, types=types)


@rule(answers=("Instruct", "Correct", "Reject"))
def miss_part(s: Record, *, types: DialogueTypes) -> Record | None:
    """A thing is said to be a part of things, or not: the robot sees no parts."""
    if not s.private.criteria or kind_of(content_of(s)) != "c":
        return None
    said = s.shared.latest.signs
    noun = next((it for it in said if claims(content_of(s), it)), None)
    if noun is None or knows_word(s, noun):
        return None
    for it in s.private.criteria:
        if it.content.get(COMPONENT) == noun.meaning:
            return _plan_answer(s, "UnseenPart", it.content, it.signs, types=types)
    return None


def _plan_answer(
    s: Record,
    act: str,
    content: RecordType,
    signs: Sequence[Record],
    *,
    types: DialogueTypes,
) -> Record:
    """The plan to say this of a criterion; what was claimed is claimed still."""
    return plan(s, act, content, signs=signs, pending=s.shared.pending, types=types)


def claimed_noun(s: Record) -> Record | None:
    """The noun that is talked about: that of a criterion, or of a claim.

    Where nothing was claimed just now it is what was last said of the topic.
    """
    meant = last_subject(s)
    if meant is not None:
        return next((it for it in s.private.nouns if it.meaning == meant), None)
    said = claim_in_question(s)
    here = [it for it in s.shared.here[::-1] if {*things_in(it)} <= {*s.shared.topic}]
    for claim in here if said is None else [said]:
        nouns = [it for it in s.private.nouns if claims(claim, it)]
        if nouns and not is_denial(claim):
            found: Record = nouns[0]
            return found
    return None


CRITICISING = first(
    weigh_claimed,
    miss_criterion_word,
    learn_criterion,
    forget_criterion,
    take_criterion_back,
    forget_last_criterion,
    see_no_parts,
    miss_part,
)
