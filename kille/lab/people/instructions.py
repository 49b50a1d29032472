"""What a person reads in each step of a dialogue: what there is, and what is wanted."""

from __future__ import annotations

from kille.lab.scenes.scene import Occasion
from kille.lab.tutors.simulated import BY
from kille.lab.tutors.tutor import Task
from kille.lab.tutors.words import Words
from kille.lab.worlds.worlds import Thing, World

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


# --- what there is --------------------------------------------------------------------


def format_view(occasion: Occasion, world: World) -> str:
    """What there is in a world, or in what a camera has taken.

    >>> from kille.lab.worlds.worlds import Thing
    >>> world = World((Thing("cup", "red", place=(2, 3)),)).point_at(1)
    >>> print(format_view(Occasion("noun", world, 1), world))
    On the table:
      #1 red cup, 2 right 3 away  <- pointed at
    """
    things = [f"  {_format_thing(world, it, occasion.view)}" for it in world.in_view]
    if occasion.view is not None:
        return "\n".join((f"Before the camera ({occasion.view}):", *things))
    return "\n".join(("On the table:", *things)) if things else "The table is empty."


def _format_thing(world: World, number: int, view: object) -> str:
    """A thing with its place, unless a camera shows that."""
    thing, (right, away) = world.thing(number), world.place(number)
    place = "" if view is not None else f", {_steps(right)} right {_steps(away)} away"
    front = f", facing {thing.front}" if thing.front else ""
    pointed = "  <- pointed at" if number == world.focus else ""
    called = f"{thing.colour} {thing.kind}".strip()
    return f"#{number} {called}{place}{front}{pointed}"


def _steps(far: float) -> str:
    return f"{round(far, 1):zg}"
