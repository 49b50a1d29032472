"""What is wanted of a tutor in each step of a dialogue, as a person reads it."""

from __future__ import annotations

from kille.lab.scenes.occasions import Occasion
from kille.lab.tutors.simulated import BY
from kille.lab.tutors.tutor import Task
from kille.lab.tutors.words import Words
from kille.lab.worlds.worlds import Thing

_LESSONS = {
    "noun": "say what #{x} is",
    "adjective": "say what colour #{x} is",
    "relation": "say where #{x} is from #{y}",
}
_QUESTIONS = {
    "noun": "ask what #{x} is",
    "adjective": "ask what colour #{x} is",
    "relation": "ask where #{x} is",
}
_ALONE = {
    "both": "",
    "noun": " by its noun alone",
    "colour": " by its colour alone",
}


def instruction(task: Task) -> str:
    """What the tutor is to do, in words.

    >>> from kille.lab.study import Run
    >>> run = Run("a", "me", "t", 1)
    >>> instruction(Task(run, "f", "forget", 1, None, {"word": "cup"}))
    'have the robot forget the word for cup'
    """
    match task.do:
        case "forget":
            return f"have the robot forget the word for {task.settings['word']}"
        case "align" if task.settings.get("announce"):
            return "say which way things face, and whose left you speak of"
        case "align":
            return "say which way things face"
        case "find":
            by = _ALONE[task.settings["by"]]
            name = task.occasion.name(task.occasion.x)
            return f"ask for the {name}{by}, at which nobody points"
    return _about(task.do, task.occasion)


def _about(do: str, it: Occasion) -> str:
    match do:
        case "teach":
            return _LESSONS[it.kind].format(x=it.x, y=it.y)
        case "ask":
            asks = _QUESTIONS[it.kind].format(x=it.x)
            return f"{asks}, and say nothing of the answer"
        case "practise":
            asks = _QUESTIONS[it.kind].format(x=it.x)
            return f"{asks}, and then say what is right"
    return f"talk of #{it.x}, or type nothing and let the robot talk"


def kept_kind(task: Task) -> str:
    """The kind of the answer that is kept in a step: of a word, or a `reference`."""
    if task.of is None or task.do not in ("ask", "practise", "find"):
        return ""
    return "reference" if task.do == "find" else task.of.kind


def question(task: Task, language: str) -> str:
    """A question to which the answer would be kept."""
    words, it = Words(language), task.occasion
    if task.do == "find":
        return words.which_question(
            words.phrase_for(it.thing, *BY[task.settings["by"]])
        )
    return words.question(it.kind)


def example(kind: str, language: str) -> str:
    """An answer with a word of this kind, or what points at a thing.

    >>> example("noun", "en"), example("relation", "en"), example("reference", "en")
    ('This is a car.', 'This is behind the car.', '#2')
    """
    words, car = Words(language), Thing("car", "red")
    match kind:
        case "noun":
            return words.lesson(kind, words.word_for(car.kind))
        case "adjective":
            return words.lesson(kind, words.word_for(car.colour))
        case "relation":
            landmark = words.phrase_for(car, "noun")
            return words.lesson(kind, words.word_for("behind"), landmark)
    return "#2"
