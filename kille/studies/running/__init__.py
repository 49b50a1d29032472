"""Running studies: by this process, by others here, or by a cluster; and once more."""

from kille.studies.running.crews import Crew, alone, crew
from kille.studies.running.replaying import Difference, replay
from kille.studies.running.runner import Progress, Summary, forget_broken, run
from kille.studies.running.schedulers import Scheduler

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
