"""One thread for sums: in several, they are added up in another order.

Then the degrees of a word differ in a late digit from one number of processors to the
next, and a dialogue may take another turn there. Dialogues are played beside each other
instead.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

from threadpoolctl import threadpool_limits

READ_WHEN_LOADED = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""What says in how many threads a library adds up, from when it is loaded."""


@contextmanager
def one_thread() -> Iterator[None]:
    """Limit numerical libraries to one thread, also those that are loaded meanwhile."""
    before = {name: os.environ.get(name) for name in READ_WHEN_LOADED}
    os.environ.update(dict.fromkeys(READ_WHEN_LOADED, "1"))
    try:
        with threadpool_limits(1):
            yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
