"""Scenes: what a study puts in front of the robot, drawn by the seed of a run.

A scene of a kind gives its occasions round by round; in the same study and seed they
are the same for every theory and every tutor. Those named in `WHOLE` are seen by the
whole robot through its own eyes, and the others are simulated.

drawn: a table on which things are laid. around: a target round a landmark. statements:
what people have said of places. rendered: a simulated camera. pictures, captures: what
a camera has taken.
"""

from kille.lab.scenes.kinds import SETTINGS, WHOLE, faults, open_scene
from kille.lab.scenes.scene import Occasion, Scene
from ttr.aliases import former_names

__all__ = ["SETTINGS", "WHOLE", "Occasion", "Scene", "faults", "open_scene"]

__getattr__ = former_names(__name__, {"opened": "open_scene"})
