"""Playing the dialogues of a study."""

import random
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from kille.lab.dialogues import Played
from kille.lab.playing import talking
from kille.lab.study import Run, Study

__all__ = ["play"]


def play(study: Study, run: Run) -> Played:
    """Play one dialogue of a study."""
    with _seed_generators(run):
        return talking.play(study, run)


@contextmanager
def _seed_generators(run: Run) -> Iterator[None]:
    """What learners and rules of one's own draw by chance follows from the run, too.

    Many a classifier draws from the generators of Python or numpy that a process has.
    """
    before, before_of_arrays = random.getstate(), np.random.get_state()  # noqa: NPY002
    chance = run.chance("whatever draws without a generator of its own")
    random.seed(chance.getrandbits(32))
    np.random.seed(chance.getrandbits(32))  # noqa: NPY002
    try:
        yield
    finally:
        random.setstate(before)
        np.random.set_state(before_of_arrays)  # noqa: NPY002
