"""The games of tutoring in a simulated world: what is seen, and what becomes of moves.

Nothing is kept but in the state and the model: a look is named by the world that it is
at, and the words that the robot knows are the witness functions of the model, which
learning replaces. So a dialogue can be played again, and go on from any of its states.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import Any

from kille.dialogue.criteria import CUE, degree_of, signs_in, what_of
from kille.dialogue.meanings import (
    DialogueTypes,
    claims,
    is_denial,
    packaged_types,
    value_at,
    word_of,
)
from kille.dialogue.reference.comparing import COMPARATIVES
from kille.dialogue.state import blank_model
from kille.dialogue.tutoring import tutoring
from kille.lab.worlds.perception import (
    across,
    between,
    comparative,
    number_of,
    thing,
    view,
)
from kille.lab.worlds.vocabulary import vocabulary
from kille.lab.worlds.word_learning import LearnedWord, WordLesson, observe
from kille.lab.worlds.worlds import World
from ttr import Model, Pred, Record, RecordType, record, replace
from ttr.aliases import former_names
from ttr.types import TypeNode
from ttr.updates import Game

__all__ = ["act", "with_known_words", "simulated_game", "word", "world_of"]

__getattr__ = former_names(
    __name__, {"known": "with_known_words", "simulated": "simulated_game"}
)


def simulated_game(
    world: World,
    signs: Iterable[Record] = (),
    *,
    colours: Iterable[Record] | None = None,
    types: DialogueTypes | None = None,
    **settings: Any,
) -> Game:
    """The games of tutoring, played in front of this world by a robot of these words.

    It has not been taught them; it knows these `colours`, or else all. `settings` are
    those of `tutoring`.

    >>> from kille.lab.worlds.worlds import Thing
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> turns = game.play(map(game.hear, ["This is a cup.", "What is this?"]))
    >>> [game.say(move) for turn in turns for move in turn.said]
    ['OK, I learned a cup.', 'This is a cup.']
    """
    types = types or packaged_types()
    if colours is None:
        colours = vocabulary(settings.get("language", "en"), types).colours
    colours = tuple(colours)
    signs = [*signs, *colours]
    game = tutoring(
        signs,
        model=model_of(world, signs, types),
        act=act,
        colours=colours,
        types=types,
        **settings,
    )
    start = replace(game.start, {"view": view(world)})
    return dataclasses.replace(game, name="simulated", start=start)


def model_of(
    world: World, signs: Iterable[Record] = (), types: DialogueTypes | None = None
) -> Model:
    """The model of what can be seen in a world, and of what these words are true of."""
    types = types or packaged_types()
    model = blank_model(types).witnessed(types["Look"], by=_is_look)
    for number in range(1, len(world.things) + 1):
        model = model.given(thing(number), types["Ind"])
    model = model.witnessed(types["between"], by=_between)
    for name in COMPARATIVES.values():
        model = model.witnessed(types[name], by=partial(_compare, name))
    return with_known_words(model.witnessed(types["across"], by=_across), signs)


def with_known_words(model: Model, signs: Iterable[Record]) -> Model:
    """Add words to a model, with what they know without lessons.

    >>> from kille.dialogue.meanings import adjective, word_of
    >>> M = with_known_words(Model(), [adjective("red")])
    >>> word(M, word_of(adjective("red"))) is not None
    True
    """
    for sign in signs:
        if word(model, word_of(sign)) is None:
            model = model.witnessed(word_of(sign), by=LearnedWord.without_lessons(sign))
    return model


def word(model: Model, pred: Pred) -> LearnedWord | None:
    """The learned word that judges a predicate in a model, if there is one.

    >>> from kille.dialogue.meanings import noun, word_of
    >>> from kille.lab.worlds.worlds import Thing
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> turn = game.take(game.begin(), game.hear("This is a cup."))
    >>> word(turn.model, word_of(noun("cup"))) is not None
    True
    """
    found = model.facts.functions.get(pred)
    return found if isinstance(found, LearnedWord) else None


def learned_words(model: Model) -> tuple[LearnedWord, ...]:
    """All learned words of a model, sorted by name."""
    found = [it for it in model.facts.functions.values() if isinstance(it, LearnedWord)]
    return tuple(sorted(found, key=lambda it: word_of(it.sign).name))


def world_of(s: Record) -> World:
    """The world that a state has the latest look at.

    >>> from kille.lab.worlds.worlds import Thing
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> world_of(game.start).thing(1).kind
    'cup'
    """
    world = World.from_name(s.view.look)
    return World() if world is None else world


def _is_look(name: object) -> bool:
    return isinstance(name, str) and World.from_name(name) is not None


def _between(x: str, y: str, z: str, look: str) -> float | tuple[float, float]:
    return between(x, y, z, look)


def _compare(
    word: str, x: str, y: str, look: str, front: str
) -> float | tuple[float, float]:
    return comparative(word, x, y, look)


def _across(x: str, look: str) -> float:
    world = World.from_name(look)
    return (
        0.0
        if world is None or number_of(x) not in world
        else across(world, number_of(x))
    )


# --- acting --------------------------------------------------------------------------


def act(planned: TypeNode, model: Model) -> tuple[Record, Model]:
    """Make a planned move: the event, with what came of it, and the model after it.

    >>> from kille.lab.worlds.worlds import Thing
    >>> game = simulated_game(World((Thing("cup", "red", place=(2, 3)),)))
    >>> turn = game.take(game.begin(), game.hear("This is a cup."))
    >>> event, _ = act(turn.said[0].type, turn.model)
    >>> event.spkr, event.addr
    ('robot', 'tutor')
    """
    move, model = model.create(planned)
    keys = []
    for content in move.teaches:
        sign = next(it for it in move.signs if claims(content, it))
        key, model = _learn(model, sign, content)
        keys.append(key)
    dropped = [key for sign in move.drops for key in keys_of(model, sign)]
    model = with_known_words(model, move.signs if move.classifies else ())
    said = []
    for content in move.weighs:
        key, model = _learn_criterion(model, content, move.signs)
        said.append(key)
    undone = _latest_lessons(model, len(move.undoes))
    keys_undone = [it.key for it in undone]
    lost, model = _unlearn(model, (*move.forgets, *dropped, *keys_undone))
    explained = [_reason(model, claim) for claim in move.explains]
    recalled = [_recollection(model, sign) for sign in move.recalls]
    cited = [
        _reminder(sign, it) for sign, it in _lessons(model) if it.key in move.cites
    ]
    done = {
        "keys": keys,
        "criteria": said,
        "dropped": dropped,
        "undone": undone or move.undone,
        "lost": lost,
        "reasons": explained,
        "recalled": recalled,
        "cited": cited,
    }
    return replace(move, done), model


def keys_of(model: Model, sign: Record) -> tuple[str, ...]:
    """The keys of all lessons of a word."""
    found = word(model, word_of(sign))
    return () if found is None else tuple(lesson.key for lesson in found.lessons)


def _learn(model: Model, sign: Record, content: RecordType) -> tuple[str, Model]:
    """Learn a content: the key of the lesson, and the model after it."""
    pred = word_of(sign)
    number = max((it.number for _, it in _lessons(model)), default=0) + 1
    taught = (word(model, pred) or LearnedWord(sign)).after_lesson(
        *claim_arguments(sign, content), holds=not is_denial(content), number=number
    )
    return taught.lessons[-1].key, model.witnessed(pred, by=taught)


def _learn_criterion(
    model: Model, content: RecordType, signs: Sequence[Record]
) -> tuple[str, Model]:
    """Learn by what things are known: the key, and the model after it."""
    subject = signs_in(content, signs)[0]
    pred, label = word_of(subject), what_of(content)[0]
    cue = str(value_at(content, CUE)) if label == CUE else ""
    before = word(model, pred) or LearnedWord(subject)
    after = before.after_criterion(cue, degree_of(content) > 0.0)
    return after.criteria[-1].key, model.witnessed(pred, by=after)


def claim_arguments(sign: Record, content: RecordType) -> tuple[str, ...]:
    """The arguments of which a content claims its word to be true."""
    look, target = value_at(content, "look"), content["target"]
    assert isinstance(target, RecordType)
    x = str(value_at(target, "x"))
    if sign.kind != "relation":
        return x, str(look)
    landmark = content["landmark"]
    assert isinstance(landmark, RecordType)
    return x, str(value_at(landmark, "x")), str(look), str(value_at(content, "frame"))


def _unlearn(model: Model, keys: Iterable[str]) -> tuple[tuple[Record, ...], Model]:
    """Forget lessons: the words that are lost, and the model after it."""
    forgotten = set(keys)
    lost = []
    for it in learned_words(model):
        left = it
        for key in it.keys:
            if key in forgotten:
                left = left.without_lesson(key)
        if left is it:
            continue
        model = model.witnessed(word_of(it.sign), by=left)
        if it.is_known and not left.is_known:
            lost.append(it.sign)
    return tuple(lost), model


def _lessons(model: Model) -> Iterator[tuple[Record, WordLesson]]:
    """All lessons, each with the sign that it is about."""
    for it in learned_words(model):
        for lesson in it.lessons:
            yield it.sign, lesson


def _latest_lessons(model: Model, count: int) -> list[Record]:
    """The last lessons, as reminders."""
    ordered = sorted(_lessons(model), key=lambda it: -it[1].number)
    return [_reminder(sign, lesson) for sign, lesson in ordered[:count]]


def _recollection(model: Model, sign: Record) -> Record:
    found = word(model, word_of(sign))
    lessons = [] if found is None else [it for it in found.lessons if it.holds]
    return record(
        sign=sign,
        lessons=float(len(keys_of(model, sign))),
        confused=[],
        qualities=[],
        reminders=[_reminder(sign, it) for it in lessons[-1:]],
    )


def _reason(model: Model, claim: RecordType) -> Record:
    """Why a claim is thought to be so: by which cues, and by which lesson.

    In a simulated world it is always now, and what was said in a lesson is its word.
    """
    sign = next(it.sign for it in learned_words(model) if claims(claim, it.sign))
    known = word(model, word_of(sign))
    of = observe(sign.kind, *claim_arguments(sign, claim))
    if known is None or of is None:
        return record(claim=claim, p=0.0, cues=[], reminders=[])
    cues = [record(name=name, share=share) for name, share in known.cues(of)]
    nearest = known.nearest(of)
    reminders = [] if nearest is None else [_reminder(sign, nearest)]
    return record(claim=claim, p=known.degree(of), cues=cues, reminders=reminders)


def _reminder(sign: Record, lesson: WordLesson) -> Record:
    return record(
        key=lesson.key,
        sign=sign,
        examples=float(lesson.holds),
        text=sign.form,
        dialogue="0",
        turn="0",
        age=0.0,
        day="today",
        time="00:00",
    )
