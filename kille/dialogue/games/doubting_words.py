"""What may be a word: the robot asks about what it doubts, before it learns that.

"This is sugar." may name a kind of thing, or say how this is, and "This is a king." may
be a joke: the robot asks, and learns only from a yes. "That's life." names nothing that
can be seen, and "This is a piece of cake." is a saying: from such it learns nothing.
The lists are those of `kille.dialogue.word_lists`; a known word is never doubted.
"""

from __future__ import annotations

from kille.dialogue.beliefs import knows_word
from kille.dialogue.commitments import kind_of
from kille.dialogue.criteria import COMPONENT
from kille.dialogue.games.second_noun import BOTH, EITHER
from kille.dialogue.meanings import (
    CLAIMS,
    DialogueTypes,
    claims,
    is_denial,
    replace_word,
    set_to,
    single_claims,
)
from kille.dialogue.moves import content_of, issue, plan
from kille.dialogue.reference import in_view
from kille.dialogue.rules import rule
from kille.dialogue.word_lists import (
    CONTRADICTORY,
    CUT_OFF,
    DOUBTFUL,
    NAME,
    PARTIAL,
    SAYING,
)
from ttr import Model, Record, RecType, rectype, replace
from ttr.updates import first

KIND = "AskKind"
"""The question whether a word is a kind of thing."""

HOW = "AskHow"
"""The question whether a word says how a thing is."""

MEANT = "AskMeant"
"""The question whether the tutor means what was understood of a sentence."""

MEANT_TOO = "AskMeantToo"
"""What it asks besides, of what the tutor has said in the same breath."""

PRESUMED = "AskPresumed"
"""The question whether a thing is called so by which the tutor has called one."""

Update = tuple[Record, Model]


@rule(answers="Doubted")
def ask_meant(s: Record, *, model: Model, types: DialogueTypes) -> Update | None:
    """Only a part of the sentence was understood: it asks whether that is meant."""
    said = s.shared.latest
    if said.doubt != PARTIAL or ("look" in said.content and not s.view.things):
        return None
    said, model = _as_intended(s, said, model, types=types)
    part = said.content.get(COMPONENT)
    if part and any(it.content.get(COMPONENT) == part for it in s.private.criteria):
        return None
    told = single_claims(said.content)[0]
    content = in_view(s, told, types=types)
    undoubted = {"doubt": ""} if "doubt" in said else {}
    asked = issue(MEANT, [replace(said, content=content, **undoubted)])
    question = plan(
        s,
        MEANT,
        told,
        signs=said.signs,
        pending=s.shared.pending,
        asks=[asked],
        types=types,
    )
    return question, model


def _as_intended(
    s: Record, said: Record, model: Model, *, types: DialogueTypes
) -> Update:
    """The move with the common word of which its new one may be a slip."""
    sign = next((it for it in said.signs if claims(said.content, it)), None)
    if "intended" not in said or sign is None or knows_word(s, sign):
        return said, model
    [common] = said.intended
    if common.kind != sign.kind:
        return as_naming(said, sign, common, model, types=types)
    signs = [common if it == sign else it for it in said.signs]
    content = replace_word(said.content, sign, common)
    return replace(said, content=content, signs=signs), model


@rule(answers="Doubted")
def tell_names(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says the name of one thing or person: it learns words for kinds."""
    if s.shared.latest.doubt != NAME or _doubted_sign(s) is None:
        return None
    return plan(s, "TellNames", types=types)


@rule(answers="Doubted")
def tell_contradiction(s: Record, *, types: DialogueTypes) -> Record | None:
    """In one breath the tutor has said that it is so and that it is not: it says so."""
    said = s.shared.latest
    if said.doubt != CONTRADICTORY:
        return None
    return plan(s, "TellContradiction", said.content, signs=said.signs, types=types)


@rule(answers="Doubted")
def ask_whole(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor breaks off in the middle of a word: it asks for all of it."""
    if s.shared.latest.doubt != CUT_OFF or _doubted_sign(s) is None:
        return None
    return plan(s, "AskWhole", types=types)


@rule(answers="Doubted")
def take_as_remark(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says what cannot be a lesson: a saying, or a word for no thing."""
    doubt, sign = s.shared.latest.doubt, _doubted_sign(s)
    if doubt in ("", PARTIAL) or (doubt != SAYING and sign is None):
        return None
    content = content_of(s)
    how_all_are = "counted" in content and sign is not None and sign.kind == "adjective"
    is_settled = how_all_are or ("look" in content and is_denial(content))
    if doubt == DOUBTFUL and not is_settled:
        return None
    return plan(s, "TakeAsRemark", types=types)


@rule(answers="Doubted")
def ask_opposed(s: Record, *, types: DialogueTypes) -> Record | None:
    """A new word is said in place of one for how things are: so it says how, too."""
    said, sign = s.shared.latest, _doubted_sign(s)
    if said.doubt != DOUBTFUL or sign is None or sign.kind != "adjective":
        return None
    denied = said.content.get("denied")
    others = [it for it in said.signs if it != sign and it.kind == "adjective"]
    if denied is None or not any(knows_word(s, it) for it in others):
        return None
    content = in_view(s, said.content, types=types)
    asked = issue(MEANT, [replace(said, content=content, doubt="")])
    pending = s.shared.pending
    return plan(
        s,
        MEANT,
        said.content,
        signs=said.signs,
        pending=pending,
        asks=[asked],
        types=types,
    )


@rule(answers="Doubted")
def ask_kind(s: Record, *, model: Model, types: DialogueTypes) -> Update | None:
    """A new word may be none for a thing: it asks before it learns it."""
    sign = _doubted_sign(s)
    if s.shared.latest.doubt != DOUBTFUL or sign is None:
        return None
    if "look" not in content_of(s):
        return None
    content = in_view(s, content_of(s), types=types)
    options = [replace(s.shared.latest, content=content, doubt="")]
    if sign.kind == "adjective":
        noun = types.sign(sign.form, "noun")
        named, model = as_naming(options[0], sign, noun, model, types=types)
        options = [named, *options]
        if _is_said_for_name(s, model, types=types):
            return _ask_name(s, named, types=types), model
    asked = issue(KIND, options)
    question = plan(
        s,
        KIND,
        sign.meaning,
        signs=[sign],
        pending=s.shared.pending,
        asks=[asked],
        types=types,
    )
    return question, model


def _is_said_for_name(s: Record, model: Model, *, types: DialogueTypes) -> bool:
    """Whether a word stands in the place of a name for a thing: "No, mug."

    So it is after a claim what a thing is, after the question which of two names is
    right, and after a lesson what it is, which the word corrects.
    """
    if any("c" in it for it in s.shared.pending):
        return True
    if s.shared.qud and s.shared.qud[0].ask in (BOTH, EITHER):
        return True
    taught = [it.content for it in s.private.lessons[-1:]]
    corrects = types.has(s.shared.latest, "Correct", model)
    return corrects and any("c" in it and it in s.shared.here for it in taught)


def _ask_name(s: Record, named: Record, *, types: DialogueTypes) -> Record:
    """The plan to ask whether a thing that it has named is called by this noun."""
    return plan(
        s,
        MEANT,
        named.content,
        signs=named.signs,
        pending=s.shared.pending,
        asks=[issue(MEANT, [named])],
        types=types,
    )


@rule(answers="Affirm")
def take_vetted(s: Record) -> Record | None:
    """The tutor means it as a word: that is what was said."""
    if not s.shared.qud or s.shared.qud[0].ask not in (KIND, HOW, MEANT):
        return None
    asked, *rest = s.shared.qud
    return replace(s, {"shared.qud": rest, "shared.latest": asked.options[0]})


@rule(answers="Deny")
def ask_how(s: Record, *, types: DialogueTypes) -> Record | None:
    """It is no kind of thing: then it may say how this is."""
    if not s.shared.qud or s.shared.qud[0].ask != KIND:
        return None
    asked, *rest = s.shared.qud
    if len(asked.options) < 2:
        return None
    meant = asked.options[1]
    sign = next(it for it in meant.signs if claims(meant.content, it))
    left = replace(s, {"shared.qud": rest})
    asks = [issue(HOW, [meant])]
    return plan(left, HOW, sign.meaning, signs=[sign], asks=asks, types=types)


@rule(answers="Deny")
def let_be(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor did not mean it as a word: nothing is learned."""
    if not s.shared.qud or s.shared.qud[0].ask not in (KIND, HOW, MEANT, PRESUMED):
        return None
    return plan(replace(s, {"shared.qud": s.shared.qud[1:]}), "LetBe", types=types)


@rule(answers=("ForgetThat", "ForgetLast"))
def let_go(s: Record, *, types: DialogueTypes) -> Record | None:
    """What the tutor takes back has not been learned yet: the robot lets it be."""
    if not s.shared.qud or s.shared.qud[0].ask not in (
        KIND,
        HOW,
        BOTH,
        MEANT,
        PRESUMED,
    ):
        return None
    if kind_of(content_of(s)) is not None:
        return None
    return plan(replace(s, {"shared.qud": s.shared.qud[1:]}), "LetBe", types=types)


def _doubted_sign(s: Record) -> Record | None:
    """The word of the latest move that would be learned, if it is not known."""
    said = s.shared.latest
    content = said.content
    if "counted" in content:
        named = [it for it in said.signs if it.kind == "noun"] or said.signs
    elif COMPONENT in content:
        named = [it for it in said.signs if it.meaning == content[COMPONENT]]
    else:
        named = [it for it in said.signs if claims(content, it)]
    new = [it for it in named if not knows_word(s, it)]
    return new[0] if new else None


def as_naming(
    said: Record, sign: Record, noun: Record, model: Model, *, types: DialogueTypes
) -> Update:
    """The move with a noun in the place of what was said as an adjective."""
    claim = types.meaning_at(noun, "Naming")["c"]
    content = rectype(
        {
            **{label: T for label, T in said.content.fields if label not in CLAIMS},
            "c": claim,
        }
    )
    signs = tuple(noun if it == sign else it for it in said.signs)
    corrects = types.has(said, "Correct", model)
    move = set_to(
        types.move_type("Heard", "Correct" if corrects else "Instruct"),
        text=types["Text"] @ said.text,
        signs=types.record_type("Heard")["signs"] @ signs,
        content=RecType @ content,
    )
    return model.create(move)


DOUBTING_WORDS = first(
    ask_meant,
    tell_names,
    tell_contradiction,
    ask_whole,
    take_as_remark,
    ask_opposed,
    ask_kind,
)
DOUBT_ANSWERED = first(take_vetted, ask_how, let_be, let_go)
"""What answers the questions whether that is a word, or takes the lesson back."""
