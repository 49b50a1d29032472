"""First words: teach the robot a cup and a book, ask it, and look at the judgement.

Run it with `python examples/12_first_words.py`. It needs no camera: the robot looks at
a simulated table.
"""

from kille import Agent
from ttr import Record, record


def show(robot: Agent, thing: str) -> None:
    """Put only this on the table, in a pose of chance."""
    print(f"\n@ show {thing}")
    robot.do(f"show {thing}")


def say(robot: Agent, text: str) -> None:
    """Say something to the robot, and print what it answers."""
    print("U>", text)
    print("S>", robot.hear(text))


def beliefs(robot: Agent) -> list[Record]:
    """What the robot thinks the thing is, the most probable first."""
    return list(robot.state.private.beliefs)


with Agent(sensor="synthetic:empty?seed=7") as robot:
    # Two lessons. Nothing is learned but what the tutor says of what is in view.

    show(robot, "cup")
    say(robot, "This is a cup.")
    show(robot, "book")
    say(robot, "This is a book.")

    # The cup again, in another pose. The answer rests on beliefs: that the situation
    # is of the type which a word means, with a probability.

    show(robot, "cup")
    say(robot, "What is this?")
    for belief in beliefs(robot):
        print(f"   {belief.sign.form}: p = {belief.p:.2f}")

    # The belief is a judgement of the robot's model. Its type is the meaning of the
    # word; `o1` is the thing in view, and the look has a name of its own.

    cup = beliefs(robot)[0].sign.meaning
    print("\nThe meaning of the word:", cup)
    look = robot.state.view.look
    judgement = robot.model.perceive(record(x="o1", look=look), cup)
    print("Is it of that type?")
    print(judgement.why)

    # What it said is a move, a record with a type, and so is what it heard. Every
    # rule that ran is in the trace, with the judgement that allowed it.

    print("\nThe rules of this turn:")
    for step in robot.exchanges[-1].steps:
        print(f"   {step.rule.name}: {step.rule.doc}")

    # What nobody taught it is neither: degrees leave room for the unknown.

    show(robot, "banana")
    say(robot, "What is this?")
    for belief in beliefs(robot):
        print(f"   {belief.sign.form}: p = {belief.p:.2f}")
