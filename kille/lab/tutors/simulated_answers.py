"""What a simulated tutor answers to what the robot wants to know."""

from __future__ import annotations

from dataclasses import replace

from kille.lab.robots.replies import Reply
from kille.lab.tutors.beliefs import Beliefs
from kille.lab.tutors.tutor import Says
from kille.lab.worlds.sayings import LESSON_ACTS

_WANTED = {
    "admit_name": "noun",
    "ask_thing": "noun",
    "ask_which": "noun",
    "admit_quality": "adjective",
    "ask_which_quality": "adjective",
    "admit_place": "relation",
    "ask_relation": "relation",
    "ask_which_place": "relation",
}
"""The kind of word that the robot wants to be told."""


def answer_robot(beliefs: Beliefs, reply: Reply, latest: Says | None) -> Says | None:
    """What a tutor answers to what the robot wants to know, if they can."""
    match reply.wants:
        case "ask_frame":
            return Says(beliefs.words.perspective(beliefs.frame), "take_frame")
        case "offer_word":
            return Says(beliefs.words.plain_move("deny"), "deny")
        case "ask_referent" | "offer_referents":
            return _name_referent(beliefs, latest)
        case "ask_example":
            return _show_example(beliefs, reply.word)
    return _tell_wanted(beliefs, reply)


def _name_referent(beliefs: Beliefs, latest: Says | None) -> Says:
    """Which thing was meant: the one that was spoken of by a phrase, or pointed at."""
    spoken = None if latest is None else latest.of
    meant = spoken or beliefs.task.occasion.thing
    phrase = beliefs.colour_phrase(meant)
    return Says(beliefs.words.mention(phrase), "mention", of=meant)


def _show_example(beliefs: Beliefs, word: str) -> Says | None:
    """Another thing in view that is called so, by its colour."""
    occasion, words = beliefs.task.occasion, beliefs.words
    for x in occasion.world.in_view:
        thing = occasion.world.thing(x)
        is_other = x != occasion.x and thing.colour and beliefs.is_only(thing.colour)
        if is_other and words.word_for(thing.kind) == word:
            phrase = words.phrase_for(thing, "adjective")
            text = words.lesson("noun", word, target=phrase)
            return Says(text, LESSON_ACTS["noun"], of=thing)
    return None


def _tell_wanted(beliefs: Beliefs, reply: Reply) -> Says | None:
    """What something is, which colour it has, or where it is, if that is wanted."""
    occasion = beliefs.task.occasion
    kind = occasion.kind if reply.wants == "ask_again" else _WANTED.get(reply.wants)
    if kind is None:
        return None
    if kind == "relation":
        return _tell_place(beliefs, reply)
    x = reply.focus if reply.wants == "ask_thing" else occasion.x
    if x is None or x not in occasion.world:
        return None
    about = occasion if x == occasion.x else replace(occasion, x=x, said="")
    about = replace(about, kind=kind)
    if not beliefs.has_word(about):
        return None
    return Says(
        beliefs.words.lesson(kind, beliefs.spoken_word(about)), LESSON_ACTS[kind]
    )


def _tell_place(beliefs: Beliefs, reply: Reply) -> Says | None:
    """How the two things stand of which the robot speaks."""
    occasion = beliefs.task.occasion
    x, y = (*reply.things, None, None)[:2]
    if x is None or y is None or not {x, y} <= set(occasion.world.in_view):
        return None
    about = replace(occasion, kind="relation", x=x, y=y)
    about = about if (x, y) == (occasion.x, occasion.y) else replace(about, said="")
    if not beliefs.has_word(about):
        return None
    word, things = beliefs.spoken_word(about), (about.thing, about.world.thing(y))
    target, landmark = (beliefs.phrase(it, reply.state) for it in things)
    text = beliefs.words.lesson("relation", word, landmark, target)
    return Says(text, "relate", of=about.landmark)
