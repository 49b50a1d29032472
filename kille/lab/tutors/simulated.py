"""The simulated tutor, who knows the world and sees how their words are taken.

They teach and ask by pointing, answer what the robot asks as long as their patience
lasts, and say after an answer whether it was right. Now and then they err. All chance
is that of the task, so that two robots meet the same tutor.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass, replace

from kille.lab.robots.replies import Reply
from kille.lab.scenes.scene import KINDS, Occasion
from kille.lab.tutors.beliefs import Beliefs, Manner
from kille.lab.tutors.simulated_answers import answer_robot
from kille.lab.tutors.tutor import Asked, Move, Says, Shows, Task, Turns, Waits
from kille.lab.worlds.sayings import QUESTION_ACTS

FEEDBACK = ("none", "confirm", "correct", "both")
"""What is said of answers: whether they are right, what is right instead, or both."""

CERTAIN = ("assert", "think", "doubt", "yes", "probably", "rather")
"""The ways of an answer that claims one thing."""

LOOKS = 2
"""How often the robot may look before the tutor takes the next turn."""

BY = {"both": ("adjective", "noun"), "noun": ("noun",), "colour": ("adjective",)}
"""The kinds of words by which a thing is asked for, by the setting of a phase."""


@dataclass(frozen=True)
class SimulatedTutor:
    """A tutor of this manner."""

    name: str
    manner: Manner

    def turns(self, task: Task) -> Turns:
        """The moves by which the tutor does a task of a phase."""
        beliefs = Beliefs(self.manner, task)
        if beliefs.has_words:
            yield from _DOES[task.do](_Performance(beliefs))


class _Performance:
    """A task as a tutor does it, as long as their patience lasts."""

    def __init__(self, beliefs: Beliefs) -> None:
        self._beliefs, self._task, self._words = beliefs, beliefs.task, beliefs.words
        self._manner, self._left = beliefs.manner, beliefs.manner.patience

    # --- tasks -----------------------------------------------------------------------

    def teach(self) -> Turns:
        """Show something, say what is so, and answer what the robot asks."""
        reply = yield Shows(self._task.occasion)
        yield from self._tell_front(reply)
        yield from self._give_lesson(reply)

    def _give_lesson(self, reply: Reply) -> Turns:
        """Say what is so of the thing that is pointed at."""
        says = self._beliefs.lesson(reply.state)
        reply = yield says
        if "see_no_such" in reply.acts or "same_thing" in reply.acts:
            reply = yield self._beliefs.lesson(None)
        yield from self._answer_questions(reply, says)

    def ask(self) -> Turns:
        """Show something and ask for a word, and say nothing of the answer."""
        yield from self._ask_word()

    def practise(self) -> Turns:
        """Ask, and then say of the answer what the feedback is."""
        reply = yield from self._ask_word()
        yield from self._give_feedback(reply)

    def _ask_word(self) -> Generator[Move, Reply, Reply]:
        """Show something and ask for a word: the reply that answers it."""
        occasion = self._task.occasion
        reply = yield Shows(occasion)
        yield from self._tell_front(reply)
        asked = self._beliefs.question(occasion)
        text, act = self._words.question(occasion.kind), QUESTION_ACTS[occasion.kind]
        return (yield from self._until_clear(Says(text, act, asked)))

    def _tell_front(self, reply: Reply) -> Turns:
        """Say which way the landmark faces, if this tutor does and it is not known."""
        landmark, y = self._task.occasion.landmark, self._task.occasion.y
        if landmark is None or not landmark.front or not self._manner.orients:
            return
        if f"faces_{landmark.front}" == reply.fronts.get(y):
            return
        phrase = self._beliefs.phrase(landmark, reply.state)
        yield Says(self._words.front_statement(landmark.front, phrase), "orient")

    def talk(self) -> Turns:
        """Show something, leave the robot the floor, and tell it what it asks.

        A robot that is driven by the tutor is told what is so at once. What it says to
        have learned alone is set right, where it is not so, as answers are.
        """
        occasion = self._task.occasion
        reply = yield Shows(occasion)
        driven = reply.state.private.strategy.mode == "driven"
        for _ in range(LOOKS):
            if driven:
                break
            occasion = occasion.look_again()
            reply = yield Waits(occasion)
            if reply.moves:
                break
        if "learned_alone" in reply.acts:
            yield from self._correct_unaided(occasion, reply)
        elif reply.wants:
            yield from self._answer_questions(reply, None)
        elif driven:
            yield from self._give_lesson(reply)

    def _correct_unaided(self, occasion: Occasion, reply: Reply) -> Turns:
        """Set right what the robot has learned by itself, if that is not so.

        If that is another thing than the one that is pointed at, point there first.
        """
        x = next(iter(reply.things), None)
        if self._manner.feedback not in ("correct", "both") or x not in occasion.world:
            return
        about = occasion.look_again().about_noun(x)
        held = self._beliefs.spoken_word(about)
        if reply.claimed_word("noun") == held or not self._beliefs.has_word(about):
            return
        if x != occasion.x:
            yield Shows(about)
        text = self._words.correction("noun", held)
        yield Says(text, "correct", corrects=True)

    def find(self) -> Turns:
        """Ask for a thing by its words."""
        occasion = self._task.occasion
        phrase = self._words.phrase_for(occasion.thing, *BY[self._task.settings["by"]])
        yield Shows(occasion.without_pointing())
        asked = Asked("reference", occasion.name(occasion.x), occasion.x)
        text = self._words.which_question(phrase)
        yield from self._until_clear(Says(text, "ask_find", asked, of=occasion.thing))

    def _until_clear(self, says: Says) -> Generator[Move, Reply, Reply]:
        """Say something, and clear up what the robot asks about it."""
        reply = yield says
        while reply.is_open and self._left > 0:
            told = answer_robot(self._beliefs, reply, says)
            if told is None:
                break
            self._left -= 1
            reply = yield replace(told, asks=says.asks)
        return reply

    def forget(self) -> Turns:
        """Have a word forgotten."""
        kind, word = KINDS[self._task.settings["what"]], self._task.settings["word"]
        text = self._words.forget_request(kind, self._words.word_for(word))
        yield Says(text, "forget_word")

    def align(self) -> Turns:
        """Say which way things face, and, if the phase says so, in whose frame."""
        occasion = self._task.occasion
        reply = yield Shows(occasion)
        for number in occasion.world.in_view:
            thing = occasion.world.thing(number)
            if thing.front:
                phrase = self._beliefs.phrase(thing, reply.state)
                reply = yield Says(
                    self._words.front_statement(thing.front, phrase), "orient"
                )
        if self._task.settings["announce"]:
            yield Says(self._words.perspective(self._beliefs.frame), "take_frame")

    # --- feedback --------------------------------------------------------------------

    def _give_feedback(self, reply: Reply) -> Turns:
        """Say of the answer to a question what the feedback is."""
        occasion = self._task.occasion
        held, said = (
            self._beliefs.spoken_word(occasion),
            reply.claimed_word(occasion.kind),
        )
        confirms = self._manner.feedback in ("confirm", "both")
        corrects = self._manner.feedback in ("correct", "both")
        if said == held and reply.way == "hedge" and corrects:
            yield from self._give_lesson(reply)
        elif said == held and (confirms or reply.way in CERTAIN):
            if confirms:
                reply = yield Says(self._words.plain_move("affirm"), "affirm")
                yield from self._answer_questions(reply, None)
            yield from self._thank()
        elif said and said != held and self._manner.matters:
            reply = yield from self._correct_reason(reply, said)
            if corrects:
                says = self._beliefs.correction(reply.state)
                reply = yield says
                yield from self._answer_questions(reply, says)
            elif confirms:
                text = self._words.rejection(occasion.kind, said)
                yield Says(text, "reject", corrects=True)
        elif corrects and said:
            says = self._beliefs.correction(reply.state)
            reply = yield says
            yield from self._answer_questions(reply, says)
        elif corrects:
            yield from self._answer_questions(reply, None)
        elif confirms and said:
            yield Says(self._words.plain_move("deny"), "deny", corrects=True)

    def _correct_reason(self, reply: Reply, said: str) -> Generator[Move, Reply, Reply]:
        """Ask why, and say of each cue that is given as a reason and does not matter
        that it does not: the reply after that."""
        reply = yield Says(self._words.plain_move("ask_why"), "ask_why")
        for cue in self._words.cited_cues(reply.reasons):
            if cue not in self._manner.matters:
                text = self._words.cue_statement(said, cue)
                reply = yield Says(text, "weigh_cue", corrects=True)
        return reply

    def _thank(self) -> Turns:
        if self._task.chance("thanks").random() < self._manner.politeness:
            yield Says(self._words.plain_move("thank"), "thank")

    def _answer_questions(self, reply: Reply, latest: Says | None) -> Turns:
        """Answer what the robot asks, as long as patience lasts."""
        while reply.wants and self._left > 0:
            told = answer_robot(self._beliefs, reply, latest)
            if told is None:
                return
            self._left -= 1
            latest = told
            reply = yield told


_DOES: Mapping[str, Callable[[_Performance], Turns]] = {
    "teach": _Performance.teach,
    "ask": _Performance.ask,
    "practise": _Performance.practise,
    "talk": _Performance.talk,
    "find": _Performance.find,
    "forget": _Performance.forget,
    "align": _Performance.align,
}
"""What the tutor does, by what is to be done in a phase."""
