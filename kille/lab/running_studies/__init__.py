"""Running studies: by this process, by others here, or by a cluster; and once more."""

from kille.lab.running_studies.crews import Crew, alone, crew
from kille.lab.running_studies.replaying import Difference, replay
from kille.lab.running_studies.runner import Progress, Summary, forget_broken, run
from kille.lab.running_studies.schedulers import Scheduler

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
