"""The topics by which the parts of the robot talk to each other.

    sensor --frames--> perception <--requests-- dialogue <--user input-- tutor
                                  --results-->           --system output-->

That is how the first robot was put together (Dobnik and de Graaf 2017, figure 1).
Here the dialogue also tells its information state, and answers programs.
"""

from __future__ import annotations

from kille.bus import Bundle, Facts, Service, Text, Topic
from kille.sensors.bus_sensor import CAMERA, COLOUR, DEPTH, Feed

__all__ = [
    "CALLS",
    "FRAMES",
    "HYPOTHESES",
    "INTERRUPTED",
    "LOOKS",
    "PROBLEMS",
    "STAGE",
    "STATE",
    "SYSTEM_OUTPUT",
    "USER_INPUT",
]

FRAMES = Feed.of_topics(COLOUR, CAMERA, DEPTH)
"""What the sensor sees.

>>> from kille.nodes.topics import FRAMES
>>> FRAMES.colour.name
'camera/rgb/image_color'
"""

LOOKS = Service(
    Topic("kille/requests", Facts),
    Topic("kille/results", Bundle),
    "kille ros perception",
)
"""Looks at the scene: the things in view with all that is measured of them.

>>> from kille.nodes.topics import LOOKS
>>> LOOKS.questions.name, LOOKS.answers.name
('kille/requests', 'kille/results')
"""

STAGE = Service(
    Topic("kille/stage/requests", Facts),
    Topic("kille/stage/results", Facts),
    "kille ros sensor",
)
"""Changes of the scene, where the sensor is one whose scene can be changed.

>>> from kille.nodes.topics import STAGE
>>> STAGE.questions.name, STAGE.answers.name
('kille/stage/requests', 'kille/stage/results')
"""

USER_INPUT = Topic("kille/user_input", Text)
"""What the tutor says; a line that begins with `@` changes what there is to see.

>>> from kille.bus import LocalBus, Text
>>> from kille.nodes.topics import USER_INPUT
>>> bus = LocalBus()
>>> bus.publisher(USER_INPUT).publish(Text("This is a cup."))
>>> bus.close()
"""

HYPOTHESES = Topic("kille/user_input_hypotheses", Facts)
"""What the tutor perhaps says: `{"texts": [["This is a cup.", 0.7], …]}`.

>>> from kille.bus import Facts
>>> from kille.nodes.topics import HYPOTHESES
>>> HYPOTHESES.name, HYPOTHESES.kind is Facts
('kille/user_input_hypotheses', True)
"""

SYSTEM_OUTPUT = Topic("kille/system_output", Text)
"""What the robot says: a message for each turn in which it says anything.

>>> from kille.bus import LocalBus, Text
>>> from kille.nodes.topics import SYSTEM_OUTPUT
>>> bus = LocalBus()
>>> listening = bus.subscribe(SYSTEM_OUTPUT, print)
>>> SYSTEM_OUTPUT.name, SYSTEM_OUTPUT.kind is Text
('kille/system_output', True)
>>> bus.close()
"""

INTERRUPTED = Topic("kille/interrupted", Text)
"""That somebody spoke over the robot: what of its latest message had been uttered.

>>> from kille.nodes.topics import INTERRUPTED
>>> INTERRUPTED.name
'kille/interrupted'
"""

STATE = Topic("kille/state", Facts, latched=True)
"""The information state after each turn, in the notation, with what led to it.

>>> from kille.nodes.topics import STATE
>>> STATE.name, STATE.latched
('kille/state', True)
"""

PROBLEMS = Topic("kille/problems", Text)
"""What went wrong, in a line; the talk goes on.

>>> from kille.nodes.topics import PROBLEMS
>>> PROBLEMS.name
'kille/problems'
"""

CALLS = Service(
    Topic("kille/calls", Facts), Topic("kille/replies", Facts), "kille ros dialogue"
)
"""What programs may ask of the robot: to say, teach, ask or forget something.

>>> from kille.nodes.topics import CALLS
>>> CALLS.questions.name, CALLS.answers.name
('kille/calls', 'kille/replies')
"""
