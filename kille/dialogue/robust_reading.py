"""Read what the grammar does not read as a whole: by its islands, and by the state.

The grammar stays the reference: each reading of an island is the type of a move, as if
it had been said alone. How well an island fits depends on what the talk is about: "yes"
where the robot has claimed something, "the red one" where it has asked which. What
would teach something, and leaves out words that are not harmless, is doubted: the robot
asks whether it is meant, and learns from a yes. Beside "if" and "looks like" nothing is
claimed, and no claim is made of a sentence whose "not" would be left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import partial
from typing import NamedTuple

from kille.dialogue.islands import (
    START,
    Cover,
    Island,
    Word,
    best_covers,
    repair,
    words_of,
)
from kille.dialogue.language import LESSONS, Sentence, Utterance, reader
from kille.dialogue.lessons_together import (
    MOST,
    are_about_unmarked_things,
    correct_lesson,
    doubt_lesson,
    fill_from,
    is_about_it,
    join_lessons,
)
from kille.dialogue.lookalikes import replace_lookalikes
from kille.dialogue.meanings import (
    DialogueTypes,
    packaged_types,
    predicate_at,
    value_at,
)
from kille.dialogue.parsing import Tree, parts
from kille.dialogue.state import words as words_in
from kille.dialogue.word_lists import (
    NAME,
    PARTIAL,
    SAYING,
    WordLists,
    plain_text,
    word_lists,
)
from ttr import Record

WHOLE = frozenset(
    {"affirm", "deny", "okay", "ask_repeat", "ask_help", "leave", "alone"}
)
"""The moves beside which nothing of their clause may be left out."""

STRICT = frozenset(
    {
        "mention",
        "take_frame",
        "about",
        "about_where",
        "ask_repeat",
        "forget_that",
        "forget_last",
        "forget_all",
        "reject_several",
        "forget_word",
        "orient",
    }
)
"""The moves beside which nothing of the sentence may be left out."""

ANYWHERE = frozenset(
    {"greet", "thank", "okay", "affirm", "deny", "mention", "take_frame"}
)
"""The moves other than claims that need not begin a clause."""

COURTESY = frozenset({"greet", "thank", "leave", "okay", "affirm", "deny"})
"""The moves after which another may begin."""

HEDGING = frozenset({"okay", "affirm", "deny", "ask_deed"})
"""The moves beside which a claim is asked about: "Maybe, this is a cup."."""

FALLBACK = frozenset({"remark", "other_deed", "presumed"})
"""What is taken so only where nothing else is understood."""

VAGUE = FALLBACK | {"alone", "named", "ask_deed"}
"""What may be read of almost any words, so that they are not understood thereby."""

INDIRECT = frozenset(
    {
        "named",
        "also_named",
        "sided",
        "alone",
        "presumed",
        "meant",
        "placed",
        "identity",
        "quality_alone",
    }
)
"""The claims that are always asked about."""

ELLIPTIC = frozenset({"is_not", "is_too", "and_how"})
"""The claims that say of another thing what was just said: "the right one isn't".

Or of the same thing something else: "and soft".
"""

GAPPED = frozenset({"gapped", "sided"})
"""The claims of which one has to stand beside another: "Mug left, cup right"."""

FULL = frozenset({"instruct", "describe", "correct", "reject", "gapped", "sided"})
"""The claims of which another may be left out in part."""

FOLLOWS = {
    "is_not": FULL | ELLIPTIC,
    "is_too": FULL | ELLIPTIC,
    "and_how": frozenset({"describe", "and_how"}),
}
"""After which claims, and nothing else, the elliptic ones may stand."""

CLAIMS = frozenset(
    (*LESSONS, "relate", "turned", "other_place", *INDIRECT, *ELLIPTIC, *GAPPED)
)
"""The moves that say how things are."""

CORRECTED = {"instruct": "correct", "describe": "correct", "relate": "correct"}
"""What a lesson is after a no: "Far from it, that's a lamp."."""

ANSWERED = frozenset({"ask_name", "ask_certainty", "ask_whether", "ask_repeat"})
"""The questions that a tutor who then says what it is has answered themselves."""

OVER_BREAKS = frozenset(
    {"correct", "reject", "named", "also_named", "meant", "turned", "other_place"}
)
"""The claims that may go on after a comma: "It is not a cup, it is a mug"."""

_UNSPEAKABLE = re.compile(r"[<>\[\]{}|\\^=@\x00-\x08\x0e-\x1f\x7f-\x9f\u202a-\u202e]")
"""Signs of markup, of programs and of terminals: what has any is not talk."""

NEW = 0.8
"""The factor for every word of an island that the robot does not know."""


ASKED = 0.3
"""The factor for a claim in a sentence that ends with a question mark."""


DOUBTING = frozenset({"ask_certainty", "ask_whether"})
"""Those of them after which a lesson corrects what the robot has claimed."""


class Situation(NamedTuple):
    """What readings are weighed by: what the talk is about, and what is in view."""

    asks_name: bool = False
    """The robot has asked what a thing is."""
    asked: str = "name"
    """What the tutor has asked of a thing last: its name or quality."""
    asks_which: bool = False
    """It has asked which thing is meant."""
    asks_whether: bool = False
    """It has claimed something, or asked something that yes and no answer."""
    things: int = 0
    """How many things are in view."""
    known: frozenset[str] = frozenset()
    """The words that it knows."""
    qualities: frozenset[str] = frozenset()
    """Those of them that say how things are."""
    points: bool = False
    """The tutor points at something."""
    colours: frozenset[str] = frozenset()
    """Those of them that say of what colour things are."""


class Understanding(NamedTuple):
    """What was understood of a sentence: moves in order, and the words it misses."""

    moves: tuple[Sentence, ...]
    parts: tuple[str, ...]
    missed: tuple[str, ...]
    is_remark: bool = False
    """Whether it only is taken as a remark."""


def prepare_to_read(
    language: str = "en", *, types: DialogueTypes | None = None
) -> None:
    """Read the grammars of a language now, so that the first sentence takes no longer.

    It takes half a second of a core, and nothing where it has been done before.
    """
    reader(language, types or packaged_types()).sentences("hm")
    read_robustly("hm", Situation(), language, types=types)


class Hearing(NamedTuple):
    """What is heard of a text: the moves in it, in order, and what is not understood.

    A lesson that the robot asks about comes last, so that the question stays open.
    """

    moves: tuple[Sentence, ...]
    missed: tuple[tuple[Sentence, Understanding], ...]


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
    ['hold_floor', 'ask_name', 'instruct']
    """
    lists = word_lists(language)
    done: list[Sentence] = []
    asked: list[Sentence] = []
    types = types or packaged_types()
    remarks: list[Sentence] = []
    missed: list[tuple[Sentence, Understanding]] = []
    for said in sentences:
        if said.readings and not _is_weak(said, situation, lists):
            done.append(said)
            continue
        found = read_robustly(said.text, situation, language, types=types)
        if said.readings and not _is_better(said, found, lists):
            done.append(said)
            continue
        if not found.moves:
            missed.append((said, found))
        if any(map(_says_name, found.moves)):
            doubts = any(_act(it.readings[0].type) in DOUBTING for it in done)
            if doubts and situation.asks_whether:
                right = [correct_lesson(it, types=types) for it in found.moves]
                found = found._replace(moves=tuple(right))
            done = [it for it in done if _act(it.readings[0].type) not in ANSWERED]
        for move in _doubt_together(found.moves, situation, types):
            aside = found.is_remark or _is_name(move)
            kind = remarks if aside else asked if _is_doubted(move) else done
            kind.append(move)
    if any(it.adds for it in asked):
        asked = [
            doubt_lesson(it, PARTIAL, types=types) for it in done if _names(it)
        ] + asked
        done = [it for it in done if not _names(it)]
    asked = asked if not any(map(_names, done)) else []
    done = list({_content(it): it for it in reversed(done)}.values())[::-1]
    told = join_lessons(asked, lists.qualities, types=types)
    moves = (*done, *told) or tuple(remarks[:1])
    if moves:
        missed = [it for it in missed if len(it[1].missed) > 1]
    return Hearing(moves, tuple(missed))


def _is_doubted_for(it: Sentence, why: str) -> bool:
    """Whether the best reading of a sentence is in doubt for this reason."""
    best = it.readings[0].type if it.readings else None
    return best is not None and "doubt" in best and value_at(best, "doubt") == why


def _is_name(it: Sentence) -> bool:
    """Whether a sentence is no lesson but a name, as in "Anna! This is a cup."."""
    return _is_doubted_for(it, NAME)


def _names(it: Sentence) -> bool:
    """Whether a sentence says what a thing is, or how."""
    acts = {_act(one.type) for one in it.readings}
    return bool(acts & {*NAMING, "describe", "instruct_several", "relate"})


def _doubt_together(
    moves: Sequence[Sentence], situation: Situation, types: DialogueTypes
) -> Sequence[Sentence]:
    """The moves of a sentence; if one of its lessons has to be asked about, all have.

    So have several lessons of which nobody knows which thing each is about.
    """
    doubted = [_is_doubted(it) for it in moves]
    lessons = [_teaches(it) for it in moves]
    open_ = situation.things > 1 and not situation.points
    if not any(doubted) and not (
        open_ and are_about_unmarked_things(moves, types=types)
    ):
        return moves
    return [
        doubt_lesson(it, PARTIAL, types=types) if taught and not in_doubt else it
        for it, taught, in_doubt in zip(moves, lessons, doubted, strict=True)
    ]


def _says_name(it: Sentence) -> bool:
    """Whether a sentence says what a thing is, and so answers what it is."""
    return not _is_name(it) and _act(it.readings[0].type) in NAMING


NAMING = ("instruct", "correct")
"""The moves by which a tutor says what a thing is."""


def situation_of(s: Record) -> Situation:
    """What the readings of a sentence are weighed by, in a state.

    >>> from kille.dialogue.state import initial
    >>> situation_of(initial()).things
    0
    """
    open_ = s.shared.qud[0].ask if s.shared.qud else ""
    said = s.private.last[-1:]
    acts = {_act(move) for move in said}
    return Situation(
        asks_name=bool(acts & ASKING_NAME),
        asked=next((what for what, it in ANSWERS.items() if acts & it), "name"),
        asks_which=open_ in ("AskReferent", "AskReferentAgain"),
        asks_whether=bool(s.shared.pending)
        or bool(open_ and open_ not in ("AskReferent", "AskReferentAgain")),
        things=len(s.view.things),
        known=frozenset(it.form for it in words_in(s)),
        qualities=frozenset(it.form for it in s.private.adjectives),
        points=bool(s.view.pointed),
        colours=frozenset(it.form for it in s.private.colours),
    )


ANSWERS = {
    "quality": {
        "assert_quality", "hedge_quality", "guess_quality", "doubt_quality",
        "admit_quality",
    },
}  # fmt: skip
"""What the robot says to a question for a quality."""

ASKING_NAME = frozenset({"admit_name", "ask_thing", "ask_again", "ask_which"})
"""What the robot says when it wants to be told what a thing is."""


def _act(move: object) -> str:
    return predicate_at(move, "e").name  # type: ignore[arg-type]


def read_robustly(
    text: str,
    situation: Situation,
    language: str = "en",
    *,
    types: DialogueTypes | None = None,
) -> Understanding:
    """What is understood of a sentence that the grammar does not read as a whole.

    >>> said = read_robustly("Umm, well, I've found a whisk!", Situation(things=1))
    >>> [move] = said.moves
    >>> move.readings[0].type["doubt"].value, said.missed
    ('partial', ("I've", 'found'))
    """
    lists, types = word_lists(language), types or packaged_types()
    reads = reader(language, types)
    plain = lists.write_out(" ".join(replace_lookalikes(text).split()))
    plain, is_sure = repair(plain, lists)
    if is_sure and plain != text:
        whole = reads.sentences(plain)
        if all(it.readings and not _is_weak(it, situation, lists) for it in whole):
            return Understanding(whole, (plain,), ())
    said = words_of(plain, lists)
    grammar = reads.island_grammar
    if grammar is None or _UNSPEAKABLE.search(text):
        return Understanding((), (), ())
    is_question = plain.rstrip().endswith("?")
    weigh = partial(_weight, situation, is_question)
    found = best_covers(plain, said, grammar, weigh, lists, FOLLOWS)
    covers = [_keep_sound(it, said, situation, is_question) for it in found]
    covers = [it for it in covers if it.islands]
    if not covers:
        return _phrases(plain, said, found)
    ranked = sorted(
        covers,
        key=lambda it: (_is_fallback(it), -_rank(it, said), it.islands[0].first),
    )

    def read(cover: Cover, island: Island) -> Sentence:
        """How an island can be read as a move, doubted where it must be."""
        doubt = _doubt(cover, island, said, lists, is_question, is_sure)
        moves = dict.fromkeys(part for tree in island.trees for part in parts(tree))
        if _follows_no(island, cover):
            moves = {
                it._replace(rule=CORRECTED.get(it.rule, it.rule)): None for it in moves
            }
        readings = reads.readings(text, moves, doubt)
        return Sentence(text, readings, adds=island.rule == "also_named")

    for n, best in enumerate(ranked):
        heard: list[Sentence] = []
        for island in best.islands:
            if _is_taken_up(island, best):
                continue
            found_here = read(best, island)
            if island.rule in ELLIPTIC:
                found_here = fill_from(found_here, heard, types=types)
            seems = heard and (
                _is_doubted_for(heard[-1], SAYING)
                or is_about_it(found_here, types=types)
            )
            if island.rule == "is_not" and seems:
                heard.pop()  # "One might think it's a bowl, but it isn't."
                found_here = doubt_lesson(found_here, PARTIAL, types=types, anew=True)
            heard.append(found_here)
        moves = {it.readings[0].type: it for it in reversed(heard) if it.readings}
        if not moves:
            continue
        found_moves = tuple(reversed(moves.values()))
        if (
            len(found_moves) == len(best.islands) == 1
            and best.islands[0].rule not in ELLIPTIC
        ):
            rivals = [
                (it.weight, read(it, it.islands[0]))
                for it in ranked[n + 1 :]
                if _are_rivals(it, best)
            ]
            found_moves = (_with_rivals(found_moves[0], best.weight, rivals),)
        return Understanding(
            found_moves,
            tuple(_text(plain, said, it) for it in best.islands),
            tuple(plain[it.begin : it.end] for it in best.missed),
            _is_fallback(best),
        )
    return _phrases(plain, said, found)


def _rank(cover: Cover, said: Sequence[Word]) -> float:
    """The weight of a cover; several names in a row are one thing to say."""
    if _is_list_of_names(cover, said):
        return cover.weight / ALONE ** (len(cover.islands) - 1)
    return cover.weight


ALONE = 0.2
"""How much less a name alone counts than what says of a thing that it is called so."""


def _follows_no(island: Island, cover: Cover) -> bool:
    """Whether a lesson comes right after a no of the same sentence: it corrects."""
    before = [it for it in cover.islands if it.first < island.first]
    return bool(before) and before[-1].rule == "deny" and island.rule in CORRECTABLE


def _is_taken_up(island: Island, cover: Cover) -> bool:
    """Whether an island is a no that is said by the correction after it."""
    after = [it for it in cover.islands if it.first > island.first]
    return island.rule == "deny" and bool(after) and after[0].rule in CORRECTABLE


CORRECTABLE = frozenset({*CORRECTED, "named", "also_named", "alone", "quality_alone"})
"""The islands that correct where they come after a no."""


def _are_rivals(cover: Cover, best: Cover) -> bool:
    """Whether a cover is another way to take a sentence as a move of the same sort."""
    if len(cover.islands) > 1 or cover.weight < RIVAL * best.weight:
        return False
    one, other = cover.islands[0].rule, best.islands[0].rule
    return not {one, other} & FALLBACK and (one in CLAIMS) == (other in CLAIMS)


RIVAL = 0.5
"""From which share of the best cover's weight on others count as well."""


def _with_rivals(
    best: Sentence, weight: float, rivals: Iterable[tuple[float, Sentence]]
) -> Sentence:
    """A move with other readings of the sentence, each as probable as its cover."""
    weighed = {it.type: (it, weight) for it in best.readings}
    for share, rival in rivals:
        for it in rival.readings:
            weighed.setdefault(it.type, (it, share))
    readings, weights = zip(*weighed.values(), strict=True)
    return Sentence(best.text, tuple(readings), tuple(weights), best.adds)


def _phrases(plain: str, said: Sequence[Word], found: Sequence[Cover]) -> Understanding:
    """No move, but perhaps phrases that are understood."""
    phrases = [
        _text(plain, said, it)
        for cover in found[:1]
        for it in cover.islands
        if it.after - it.first > 1 and it.rule not in VAGUE
    ]
    missed = tuple(plain[it.begin : it.end] for it in said if not it.is_harmless)
    return Understanding((), tuple(phrases), missed)


def _keep_sound(
    cover: Cover, said: Sequence[Word], situation: Situation, is_question: bool
) -> Cover:
    """The cover without islands that may not stand in it as they do: those it misses.

    A yes that answers nothing, and what is said again, is not missed.
    """
    for n, island in enumerate(cover.islands):
        if _may_stand(island, cover, said, situation, is_question):
            continue
        inside = said[island.first : island.after]
        again = any(it.rule == island.rule for it in cover.islands[:n])
        idle = island.rule == "affirm" or (again and island.rule in STRICT)
        gone = () if idle else tuple(it for it in inside if not it.is_harmless)
        less = Cover(
            (*cover.islands[:n], *cover.islands[n + 1 :]),
            tuple(sorted((*cover.missed, *gone))),
            cover.weight * UNSOUND,
        )
        return _keep_sound(less, said, situation, is_question)
    return cover


UNSOUND = 0.05
"""The factor for an island that cannot be taken as what it could be alone."""


def _may_stand(
    island: Island,
    cover: Cover,
    said: Sequence[Word],
    situation: Situation,
    is_question: bool,
) -> bool:
    """Whether an island may be taken as the move that it would be alone."""
    rule, first = island.rule, said[island.first]
    inside = said[island.first : island.after]
    is_claim = rule in CLAIMS
    near = cover.missed_near(island, said)
    earlier = [it for it in cover.islands if it.first < island.first]
    others = [it for it in cover.islands if it != island and it.rule in CLAIMS]
    match rule:
        case _ if rule in FALLBACK and len(cover.islands) > 1:
            return False
        case _ if (rule in STRICT and cover.missed) or (rule in WHOLE and near):
            return False
        case _ if inside[-1].joins:
            return False
        case _ if rule in STRICT and any(it.rule == rule for it in earlier):
            return False
        case "placed" | "identity" | "quality_alone" if (
            len(cover.islands) > 1 or cover.missed
        ):
            return False
        case "mention":
            return situation.asks_which
        case "presumed":
            begins = all(it.is_harmless for it in said[: island.first])
            return begins and situation.things == 1 and not is_question
        case "ask_repeat" if len(cover.islands) > 1:
            return False
        case "other_place" if cover.missed or not situation.asks_whether:
            return False
        case "deny" if _is_taken_up(island, cover) and not is_question:
            return all(it.is_harmless for it in said[: island.first])
        case "affirm" | "deny" if others or is_question:
            return False
        case _ if rule in ELLIPTIC:
            return bool(earlier) and earlier[-1].rule in FOLLOWS[rule]
        case _ if rule in GAPPED and rule != "instruct":
            return bool(others)
        case "deny" if any(it.rule == "okay" for it in cover.islands):
            return False
        case "affirm" | "deny" if cover.missed:
            begins = all(it.is_harmless for it in said[: island.first])
            return situation.asks_whether and begins
        case "alone":
            if any(it.is_harmless for it in inside) or len(inside) > LONGEST_NAME:
                return False
            babble = len({it.form for it in inside}) < len(inside)
            after = not any(it < first for it in cover.missed)
            far = after or situation.asks_name
            aside = LONGEST_ASIDE if far else LONGEST_NAME
            listed = _is_list_of_names(cover, said)
            if is_question or babble or len(cover.missed) > aside:
                return False
            if others and not listed:
                return False
        case "reject" if _is_bare(island) and inside[-1].clause > first.clause:
            return False
        case "instruct" if _is_bare(island) and any(map(_has_target, others)):
            return False
        case "ask_deed" if any(it < first for it in cover.missed):
            return False
        case _ if rule.startswith("ask_") and len(near) > len(inside):
            return False
    if is_claim and rule not in OVER_BREAKS and inside[-1].clause > first.clause:
        return False
    ends = all(it.is_harmless for it in said[island.after :])
    bare = rule == "alone" or (_is_bare(island) and rule != "named")
    if is_claim and is_question and ends and bare:
        return False
    courteous = [it for it in cover.islands if it.rule in COURTESY]
    polite = {at for it in courteous for at in range(it.first, it.after)}
    begins = all(
        it.is_harmless or it.clause < first.clause or at in polite
        for at, it in enumerate(said[: island.first])
    )
    return begins or rule in ANYWHERE or is_claim


def _is_list_of_names(cover: Cover, said: Sequence[Word]) -> bool:
    """Whether all that is said are a few names: "pen, pencil"."""
    clauses = {said[it.first].clause for it in cover.islands}
    alone = all(it.rule == "alone" for it in cover.islands)
    return alone and not cover.missed and len(clauses) == len(cover.islands) <= MOST


LONGEST_NAME = 3
"""How many words a name alone has at most."""

LONGEST_ASIDE = 8
"""How many words may stand after a name alone; before it, no more than it may have."""


def _is_bare(island: Island) -> bool:
    """Whether a lesson only names, without saying what: "a cup"."""
    return len(parts(parts(island.trees[0])[0])) == 1


def _has_target(island: Island) -> bool:
    return not _is_bare(island)


def _doubt(
    cover: Cover,
    island: Island,
    said: Sequence[Word],
    lists: WordLists,
    is_question: bool,
    is_sure: bool,
) -> str:
    """Why what an island claims is not learned at once, or nothing."""
    rule = island.rule
    if rule not in CLAIMS:
        return ""
    taken_up = [it for it in cover.islands if _is_taken_up(it, cover)]
    no = {at for it in taken_up for at in range(it.first, it.after)}
    runs = lists.harmless_runs([it.form for it in said])
    no |= {at for run in runs if len(run) > 1 for at in run}  # "if you like"
    forms = [it.form for at, it in enumerate(said) if at not in no]
    if lists.is_unreal(forms):
        return SAYING
    near = {it.form for it in cover.missed_near(island, said)}
    if rule in INDIRECT:
        near |= {it.form for it in said[island.first : island.after]}
    if near & lists.negations:
        return SAYING
    asks = is_question and all(it.is_harmless for it in said[island.after :])
    hedged = any(
        it.rule in HEDGING and not _is_taken_up(it, cover) for it in cover.islands
    )
    unsure = rule in INDIRECT or hedged or asks or bool(cover.missed) or not is_sure
    return PARTIAL if unsure else ""


def _weight(situation: Situation, is_question: bool, tree: Tree) -> float:
    """How well a reading of an island fits what the talk is about."""
    move = parts(tree)[0]
    rule = move.rule if tree.rule == START else tree.rule
    weight = NEW ** sum(it not in situation.known for it in _new_words(move))
    if is_question and rule in CLAIMS:
        weight *= ASKED
    match rule:
        case "affirm" | "deny":
            return weight * (1.0 if situation.asks_whether else 0.95)
        case "mention":
            return weight * (1.0 if situation.asks_which else 0.02)
        case "take_frame":
            return weight * 0.02
        case "alone":
            return weight * (0.5 if situation.asks_name else 0.25)
        case "remark":
            return weight * 0.02
        case "quality_alone":
            known = all(it in situation.qualities for it in _new_words(move))
            return weight * (0.5 if known or situation.asked == "quality" else 0.0)
        case "presumed":
            new = any(it not in situation.known for it in _new_words(move))
            return weight * (0.05 if new else 0.0)
        case "about" if _has_part(move, "it"):
            return 0.0
        case "about":
            return weight * (0.02 if situation.asks_which else 0.9)
        case "about_where":
            known = all(it in situation.known for it in _new_words(move))
            return weight * (0.9 if known or len(parts(move)) > 1 else 0.0)
        case "instruct_some":
            return weight * 0.5
        case "okay" if situation.asks_whether:
            return weight * 0.9
        case "ask_deed" | "count_sort":
            return weight * 0.5
        case "choice":
            return weight * 2.0
        case "choice_colour":
            named = all(it in situation.colours for it in _new_words(parts(move)[1]))
            return weight * (2.0 if named else 0.0)
        case "instruct" if len(parts(move)) == 1:
            return weight * 0.6
    return weight


def _new_words(tree: Tree) -> Iterable[str]:
    """The words in a part that may be learned, part by part."""
    for child in tree.children:
        if isinstance(child, Tree):
            yield from _new_words(child)
        elif child.terminal not in ("A", "PREP", "OF", "SIDE", "ARTICLE"):
            yield child.text.lower()


def _has_part(tree: Tree, rule: str) -> bool:
    """Whether a part, or a part of it, is made by a rule."""
    return any(it.rule == rule or _has_part(it, rule) for it in parts(tree))


def _is_fallback(cover: Cover) -> bool:
    return all(it.rule in FALLBACK for it in cover.islands)


def _is_doubted(it: Sentence) -> bool:
    """Whether the best reading of a sentence is in doubt."""
    return "doubt" in it.readings[0].type


def needs_parts(
    sentences: Iterable[Sentence], situation: Situation, language: str = "en"
) -> bool:
    """Whether some sentence is none, or may better be read by its parts.

    The grammar may read what is no sentence of its own by unknown words: "No worries."
    as a correction, and "This is, uh, a cup." as how two things stand.
    """
    lists = word_lists(language)
    return any(not it.readings or _is_weak(it, situation, lists) for it in sentences)


def _is_weak(it: Sentence, situation: Situation, lists: WordLists) -> bool:
    """Whether a sentence answers what nobody asked, or is in doubt, or has fillers."""
    if lists.write_out(it.text) != it.text:
        return True
    for one in it.readings:
        act = predicate_at(one.type, "e").name
        if act != "mention" or situation.asks_which:
            break
    else:
        return True
    return all(
        "doubt" in one.type or any(_is_odd(sign, lists) for sign in one.signs)
        for one in it.readings
    )


def _is_odd(sign: Record, lists: WordLists) -> bool:
    """Whether what was read as a word has a part that is none of such words'."""
    parts = sign.form.split()
    if sign.kind == "relation":
        return parts[0] in lists.articles or not lists.fillers.isdisjoint(parts)
    return any(map(lists.is_closed, parts))


def _is_better(said: Sentence, found: Understanding, lists: WordLists) -> bool:
    """Whether the parts of a sentence are a better reading than that of the whole."""
    if not found.moves or found.is_remark:
        return False
    mentions = all(predicate_at(it.type, "e").name == "mention" for it in said.readings)
    if not found.missed and any(_spans_break(it) for it in said.readings):
        return True
    fills = not lists.fillers.isdisjoint(plain_text(said.text).split())
    fills = fills or lists.write_out(said.text) != said.text
    return mentions or fills or not (found.missed or any(map(_is_doubted, found.moves)))


def _spans_break(reading: Utterance) -> bool:
    """Whether some word of a reading goes on after a comma: "lamp, also called …"."""
    text = " ".join(reading.text.lower().split())
    unbroken = " ".join(_COMMA.sub(" ", text).split())
    several = (it.form for it in reading.signs if " " in it.form)
    return any(it not in text and it in unbroken for it in several)


_COMMA = re.compile(r"[,;:]")


def _content(it: Sentence) -> object:
    """What a sentence says, whatever its words are: thanks twice are thanks."""
    first = it.readings[0].type
    return first["e"], first["content"]


def _teaches(it: Sentence) -> bool:
    """Whether a sentence says how things are, by the name of its move."""
    return any(predicate_at(one.type, "e").name in CLAIMS for one in it.readings)


def _text(plain: str, said: Sequence[Word], island: Island) -> str:
    """The stretch of the text that an island is."""
    return plain[said[island.first].begin : said[island.after - 1].end]
