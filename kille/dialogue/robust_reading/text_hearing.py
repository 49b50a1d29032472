"""What is heard of a text of several sentences: its moves, and what is missed.

A lesson that the robot asks about comes last, and others are asked about with it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import replace
from typing import NamedTuple

from kille.dialogue.language import Sentence, Utterance, reader, understand
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    packaged_types,
    predicate_at,
    set_to,
    value_at,
)
from kille.dialogue.moves import words_in
from kille.dialogue.robust_reading.contradictions import settle_contradictions
from kille.dialogue.robust_reading.island_kinds import CLAIMS
from kille.dialogue.robust_reading.lessons_together import (
    are_about_unmarked_things,
    correct_lesson,
    doubt_lesson,
    is_about_unmarked_thing,
    join_descriptions,
    join_lessons,
)
from kille.dialogue.robust_reading.sentence_reading import (
    Understanding,
    is_saying,
    read_robustly,
)
from kille.dialogue.robust_reading.situations import Situation, situation_of
from kille.dialogue.robust_reading.whole_sentences import (
    are_parts_better,
    is_weak,
    needs_parts,
)
from kille.dialogue.state import words
from kille.dialogue.word_lists import (
    CONTRADICTORY,
    NAME,
    PARTIAL,
    WordLists,
    plain_text,
    word_lists,
)
from ttr import Record, RecType

SELF_ANSWERED = frozenset({"ask_name", "ask_certainty", "ask_whether", "ask_repeat"})
"""The questions that a tutor who then says what it is has answered themselves."""

DOUBTING = frozenset({"ask_certainty", "ask_whether"})
"""Those of them after which a lesson corrects what the robot has claimed."""

ANSWERS = frozenset({"affirm", "deny"})
"""What is about something that the robot has said."""

HESITATING = frozenset({"hold_floor", "release_floor", "ask_repeat"})
"""What is said in search of words, where anything else is said: "Hang on, a whisk."."""

NAMING = frozenset({"instruct", "correct"})
"""The moves by which a tutor says what a thing is."""

TEACHING = NAMING | {"describe", "instruct_several", "relate"}
"""Those by which a tutor says what a thing is, or how, or where."""


_TAKING_BACK = frozenset({"correct", "reject"})
"""The lessons that take back what was said before in the same text."""

_FORGETTING = frozenset({"forget_about", "forget_word", "forget_all"})
"""What says which lessons are taken back."""

_REGRETTING = frozenset({"deny", "okay", "forget_that", "forget_last"})
"""What only says that something is, beside those: "No, forget cup, scratch that."."""

_SEVERAL = 2
"""Things in view of which it may not be clear which one is meant."""


class Hearing(NamedTuple):
    """What is heard of a text: the moves in it, in order, and what is not understood.

    A lesson that the robot asks about comes last, so that the question stays open.
    """

    moves: tuple[Sentence, ...]
    missed: tuple[tuple[Sentence, Understanding], ...]
    in_parts: bool = True
    """Whether it is read by its parts: then a question of the robot's ends the turn."""


def prepare_to_read(
    language: str = "en", *, types: DialogueTypes | None = None
) -> None:
    """Read the grammars of a language now, so that the first sentence takes no longer.

    It takes half a second of a core, and nothing where it has been done before.
    """
    reader(language, types or packaged_types()).sentences("hm")
    read_robustly("hm", Situation(), language, types=types)


def hear_text(
    text: str, s: Record, language: str = "en", *, types: DialogueTypes | None = None
) -> Hearing:
    """What is heard of a text in a state, as a whole or by its parts.

    >>> from kille.dialogue.state import initial
    >>> heard = hear_text("Hm, so what is this?", initial())
    >>> [it.readings[0].type["e"].pred.name for it in heard.moves], heard.missed
    (['ask_name'], ())
    """
    types = types or packaged_types()
    text = fill_noun(text, s, language)
    sentences = [
        complete_answer(it, s, language, types=types)
        for it in understand(text, language, types=types)
    ]
    situation = situation_of(s)
    if needs_parts(sentences, situation, language):
        return hear_in_parts(sentences, situation, language, types=types)
    moves = settle_moves(sentences, situation, types=types)
    return Hearing(moves, (), in_parts=False)


def converse_question(
    said: Sentence, s: Record, language: str = "en", *, types: DialogueTypes
) -> Sentence:
    """The question how two things stand, in the converse of a relation not learned.

    Who was told that the book is to the left of the cup can tell if the cup is to the
    right of the book. So it is where both words are known, and only the one was said of
    what is here. A question by a word that has an opposite is directed.
    """
    known = {it.form: it for it in s.private.relations}
    if not known or not said.readings or act_of(said) != "ask_whether":
        return said
    here = {it.sign.form for it in s.private.lessons if it.content in s.shared.here}
    settled = here & set(known) or set(known)
    opposites = word_lists(language).opposites
    readings = [
        _direct(_converse(it, known, settled, opposites, types), opposites, types)
        for it in said.readings
    ]
    return replace(said, readings=tuple(readings))


def _direct(
    reading: Utterance, opposites: Mapping[str, str], types: DialogueTypes
) -> Utterance:
    """A reading that says so if it asks by a word that has an opposite."""
    asked = [it.form for it in reading.signs if claims(reading.content, it)]
    if "stance" in reading.type or opposites.keys().isdisjoint(asked):
        return reading
    stance = types.record_type("Directed")["stance"]
    return Utterance(reading.text, set_to(reading.type, stance=stance))


def _converse(
    reading: Utterance,
    known: Mapping[str, Record],
    settled: Set[str],
    opposites: Mapping[str, str],
    types: DialogueTypes,
) -> Utterance:
    """A reading with the converse of its relation, unless that itself is settled."""
    content = reading.content
    said = next((it for it in reading.signs if it.kind == "relation"), None)
    if said is None or said.form in settled or not claims(content, said):
        return reading
    opposite = opposites.get(said.form, "")
    if said.form in known and opposite not in settled:
        return reading
    converse = known.get(opposite)
    if converse is None or not {"target", "landmark"} <= set(content.labels):
        return reading
    turned = set_to(
        content,
        target=content["landmark"],
        landmark=content["target"],
        rel=converse.meaning["rel"],
    )
    signs = tuple(converse if it == said else it for it in reading.signs)
    move = set_to(
        reading.type,
        signs=types.record_type("Heard")["signs"] @ signs,
        content=RecType @ turned,
    )
    return Utterance(reading.text, move)


def settle_moves(
    said: Sequence[Sentence], situation: Situation, *, types: DialogueTypes
) -> tuple[Sentence, ...]:
    """The moves of sentences that are read as a whole, as far as each makes sense.

    Without a yes that comes too early, and with what contradicts itself doubted.
    """
    moves = without_early_answers(said)
    if len(moves) < _SEVERAL or not all(it.readings for it in moves):
        return moves
    return tuple(settle_contradictions(moves, situation.things, types=types))


def without_early_answers(said: Iterable[Sentence]) -> tuple[Sentence, ...]:
    """The moves without a yes or no after a question that they ask: it came too early.

    It is about nothing that the robot has said, which answers only then.

    >>> moves = understand("Is this a cup? Yes, right.")
    >>> [act_of(it) for it in without_early_answers(moves)]
    ['ask_whether']
    """
    kept: list[Sentence] = []
    for it in said:
        asks = any(one.readings and act_of(one).startswith("ask_") for one in kept)
        if not (asks and it.readings and act_of(it) in ANSWERS):
            kept.append(it)
    return tuple(kept)


def fill_noun(text: str, s: Record, language: str = "en") -> str:
    """The text with the word that was claimed or learned last, where it says so little.

    "That's another one." is "That's another cup." after "This is a cup.", and "So is
    this." is "This is red too." after "This is red.". Where the robot has just pointed
    out a cup, "No, the other one." says which one is. Where it has said how two things
    stand, "No, left." says how they do.
    """
    for claim in (it for it in s.shared.pending[:1] if "rel" in it):
        stands = next((it.form for it in words(s) if claims(claim, it)), "")
        text = word_lists(language).fill_side(text, stands)
    said = [predicate_at(it, "e").name for it in s.private.last[-1:]]
    is_elsewhere = "point_out" in said
    signs = words_in(words(s), *s.shared.pending[:1])
    if not signs and not is_elsewhere:
        signs = [it.sign for it in s.private.lessons[-1:]]
    lists = word_lists(language)
    for sign in signs:
        if sign.kind == "noun":
            a_noun = lexicon(language).with_article(sign.form, sign.article)
            return lists.fill_noun(text, sign.form, a_noun, is_elsewhere=is_elsewhere)
        if sign.kind == "adjective" and not is_elsewhere:
            return lists.fill_noun(text, "", sign.form)
    return text


def complete_answer(
    sentence: Sentence, s: Record, language: str = "en", *, types: DialogueTypes
) -> Sentence:
    """The sentence; in full if it only says which thing is meant, as in "Red.".

    What asks how things stand by a word that was not learned is asked by its converse.
    """
    sentence = converse_question(sentence, s, language, types=types)
    if sentence.readings or not situation_of(s).asks_which:
        return sentence
    text = lexicon(language).answering.replace("{text}", sentence.text)
    first, *more = understand(text, language, types=types)
    return sentence if more else Sentence(sentence.text, first.readings)


def hear_in_parts(
    sentences: Iterable[Sentence],
    situation: Situation,
    language: str = "en",
    *,
    types: DialogueTypes | None = None,
) -> Hearing:
    """What is heard of the sentences of a text, some of them only in part.

    >>> from kille.dialogue.language import understand
    >>> text = "Hang on. I have found a whisk! What is this?"
    >>> heard = hear_in_parts(understand(text), Situation(things=1))
    >>> [it.readings[0].type["e"].pred.name for it in heard.moves]
    ['ask_name', 'instruct']
    """
    lists = word_lists(language)
    types = types or packaged_types()
    done: list[Sentence] = []
    asked: list[Sentence] = []
    remarks: list[Sentence] = []
    missed: list[tuple[Sentence, Understanding]] = []
    turns_away = False
    for said in sentences:
        found = _read_parts(said, situation, language, lists, types)
        moves: Sequence[Sentence] = (said,) if found is None else found.moves
        if turns_away and _is_about_unclear_thing(moves, situation, types):
            if not missed:
                words = tuple(said.text.split())
                missed.append((said, Understanding((), (), words)))
            continue
        turns_away |= _turns_away(said, moves, situation, lists)
        if found is None:
            done.append(said)
            continue
        if not found.moves:
            missed.append((said, found))
        elif not found.is_remark:
            missed += [_miss_clause(it) for it in found.dropped]
        if (not moves or found.is_remark) and _says_no(said, lists):
            lessons = [it for it in done if _teaches(it)]
            asked += [doubt_lesson(it, PARTIAL, types=types) for it in lessons]
            done = [it for it in done if not _teaches(it)]
        if any(map(_says_name, moves)):
            if situation.asks_whether and any(act_of(it) in DOUBTING for it in done):
                moves = [correct_lesson(it, types=types) for it in moves]
            done = [it for it in done if act_of(it) not in SELF_ANSWERED]
        for move in _doubt_together(moves, situation, types):
            aside = found.is_remark or _is_name(move)
            kind = remarks if aside else asked if is_doubted(move) else done
            kind.append(move)
    told = settle_contradictions([*done, *asked], situation.things, types=types)
    against = [it for it in told if _is_contradictory(it)]
    done = [it for it in told if not is_doubted(it)]
    asked = [it for it in told if is_doubted(it) and it not in against]
    idle = HESITATING | {"okay"} if asked or remarks else HESITATING
    meant = [it for it in done if act_of(it) not in idle]
    done = meant if meant or asked or remarks or against else done
    if any(act_of(it) in _FORGETTING for it in done):
        done = [it for it in done if act_of(it) not in _REGRETTING]
    done = _keep_last_answer(without_early_answers(done))
    done = join_descriptions(done, situation.known, types=types)
    asked = [it for it in asked if not _is_said_again(it, done)]
    settled, open_ = _settle_lessons(done, asked, types)
    sayings = [it for it in open_ if is_saying(it)]
    if len(sayings) < len(open_):
        open_ = [it for it in open_ if it not in sayings]
        missed += [
            _miss_clause(it.part) for it in sayings if _is_clause(it.part, lists)
        ]
    joined, rest = join_lessons(open_, lists.qualities, types=types)
    missed += [_miss_clause(it.part) for it in rest if _is_clause(it.part, lists)]
    heard = (*against, *_without_repetitions(settled), *joined) or tuple(remarks[:1])
    if heard:
        missed = [it for it in missed if len(it[1].missed) > 1]
    return Hearing(heard, tuple(missed))


def _is_clause(part: str, lists: WordLists) -> bool:
    """Whether a part of a sentence says something of something: it has a copula."""
    forms = part.lower().replace("’", "'").split()
    return any(map(lists.has_copula, forms))


def _miss_clause(clause: str) -> tuple[Sentence, Understanding]:
    """A clause of which nothing is understood, beside others that are."""
    return Sentence(clause, ()), Understanding((), (), tuple(clause.split()))


def _keep_last_answer(said: Sequence[Sentence]) -> list[Sentence]:
    """The moves with the last yes or no only: "No ... hang on, yes, quite right."."""
    answers = [n for n, it in enumerate(said) if act_of(it) in ANSWERS]
    return [it for n, it in enumerate(said) if n not in answers[:-1]]


def _turns_away(
    said: Sentence, moves: Sequence[Sentence], situation: Situation, lists: WordLists
) -> bool:
    """Whether a sentence says which thing is meant, or is not, and is not understood.

    "Not that one, the one beside it!", and "The other one." where nobody asked.
    """
    if not moves:
        forms = plain_text(lists.write_out(said.text)).split()
        return not lists.negations.isdisjoint(forms)
    return not situation.asks_which and any(map(_says_which_only, moves))


def _says_which_only(it: Sentence) -> bool:
    """Whether a move only says which thing is meant, and by no noun."""
    if act_of(it) == "correct_thing":
        return not it.readings[0].signs
    return act_of(it) == "mention"


def _says_no(said: Sentence, lists: WordLists) -> bool:
    """Whether a sentence begins with a no: "Hm, no, they would say bench."."""
    forms = plain_text(lists.write_out(said.text)).split()
    meant = [it for it in forms if it not in lists.fillers]
    return bool(meant) and meant[0] in lists.negations


def _is_about_unclear_thing(
    moves: Sequence[Sentence], situation: Situation, types: DialogueTypes
) -> bool:
    """Whether a lesson is about one of several things, to which nobody now points."""
    if situation.things < _SEVERAL or situation.points_anew:
        return False
    return any(
        claims_something(it) and is_about_unmarked_thing(it, types=types)
        for it in moves
    )


def _read_parts(
    said: Sentence,
    situation: Situation,
    language: str,
    lists: WordLists,
    types: DialogueTypes,
) -> Understanding | None:
    """What is understood of a sentence by its parts; None where the whole is better."""
    if said.readings and not is_weak(said, situation, lists):
        return None
    found = read_robustly(said.text, situation, language, types=types)
    moves = () if found.is_remark else found.moves
    if said.readings and not are_parts_better(said, moves, not found.missed, lists):
        return None
    return found


def _settle_lessons(
    done: Sequence[Sentence], asked: Sequence[Sentence], types: DialogueTypes
) -> tuple[Sequence[Sentence], Sequence[Sentence]]:
    """What is done, and what is asked about.

    A second word for a thing is asked about together with the first; beside a lesson
    that is learned, no other is asked about, unless it takes that lesson back.
    """
    if any(act_of(it) in _TAKING_BACK for it in asked):
        done = [it for it in done if not _teaches(it)]
    if any(it.adds for it in asked):
        lessons = [
            doubt_lesson(it, PARTIAL, types=types) for it in done if _teaches(it)
        ]
        asked = [*lessons, *asked]
        done = [it for it in done if not _teaches(it)]
    return done, asked if not any(map(_teaches, done)) else []


def _is_said_again(it: Sentence, said: Iterable[Sentence]) -> bool:
    """Whether a sentence only says again how a thing is: "Soft, that is."."""
    forms = {sign.form for sign in it.readings[0].signs}
    hows = [one for one in said if act_of(one) == "describe"]
    told = {sign.form for one in hows for sign in one.readings[0].signs}
    return bool(forms) and forms <= told


def _without_repetitions(said: Sequence[Sentence]) -> list[Sentence]:
    """The moves, of which none says the same as another: thanks twice are thanks."""
    return list({_content(it): it for it in reversed(said)}.values())[::-1]


def _content(it: Sentence) -> object:
    """What a sentence says, whatever its words are."""
    first = it.readings[0].type
    return first["e"], first["content"]


def _doubt_together(
    moves: Sequence[Sentence], situation: Situation, types: DialogueTypes
) -> Sequence[Sentence]:
    """The moves of a sentence; if one of its lessons has to be asked about, all have.

    So have several lessons of which nobody knows which thing each is about.
    """
    open_ = situation.things > 1 and not situation.points
    if not any(map(is_doubted, moves)) and not (
        open_ and are_about_unmarked_things(moves, types=types)
    ):
        return moves
    return [
        doubt_lesson(it, PARTIAL, types=types)
        if claims_something(it) and not is_doubted(it)
        else it
        for it in moves
    ]


def act_of(it: Sentence) -> str:
    """The name of the move that a sentence best is read as."""
    return str(predicate_at(it.readings[0].type, "e").name)


def is_doubted(it: Sentence) -> bool:
    """Whether the best reading of a sentence is in doubt."""
    return "doubt" in it.readings[0].type


def _is_contradictory(it: Sentence) -> bool:
    """Whether a move says what the same text takes back."""
    return is_doubted(it) and value_at(it.readings[0].type, "doubt") == CONTRADICTORY


def _is_name(it: Sentence) -> bool:
    """Whether a sentence is no lesson but a name, as in "Anna! This is a cup."."""
    return is_doubted(it) and value_at(it.readings[0].type, "doubt") == NAME


def _says_name(it: Sentence) -> bool:
    """Whether a sentence says what a thing is, and so answers what it is."""
    return not _is_name(it) and act_of(it) in NAMING


def _teaches(it: Sentence) -> bool:
    """Whether a sentence may say what a thing is, or how, or where."""
    return any(predicate_at(one.type, "e").name in TEACHING for one in it.readings)


def claims_something(it: Sentence) -> bool:
    """Whether a sentence says how things are, by the name of its move."""
    return any(predicate_at(one.type, "e").name in CLAIMS for one in it.readings)
