"""Running studies: by this process, by others here, or by a cluster; and once more."""

from kille.lab.running.crews import Crew, alone, crew
from kille.lab.running.replaying import Difference, replay
from kille.lab.running.runner import Progress, Summary, forget_broken, run
from kille.lab.running.schedulers import Scheduler

__all__ = [
    "Crew",
    "Difference",
    "Progress",
    "Scheduler",
    "Summary",
    "alone",
    "crew",
    "forget_broken",
    "replay",
    "run",
]
