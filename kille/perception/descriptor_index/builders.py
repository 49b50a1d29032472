"""Build the parts of an index, either on demand or in the background.

`AtOnce` builds what is asked for when it is asked for, so that the same lessons and
questions give the same answers whatever the machine does: for tests and evaluations.
`Background` builds in threads, so that neither learning nor asking waits for trees,
as a robot in conversation needs. FLANN lets other threads run while it builds.
"""

from __future__ import annotations

import logging
import threading
import weakref
from collections import deque
from collections.abc import Sequence
from typing import Protocol

from kille.perception.descriptor_index.index_parts import Part
from kille.perception.descriptor_index.views import GoneError

_QUICK = 200_000  # descriptors; trees over these take about a third of a second
_PATIENCE = 20_000  # descriptors; trees over these take about .03 s
_LONG = 1.0  # seconds


class Builder(Protocol):
    """Arranges that parts are built.

    >>> import numpy as np
    >>> from kille.perception.descriptor_index import AtOnce, Index, View
    >>> view = View(1, "cup", np.eye(2, 128, dtype=np.uint8))
    >>> builder: Builder = AtOnce()
    >>> Index([view], builder=builder).labels
    ('cup',)
    """

    def begin(self, parts: Sequence[Part]) -> None:
        """Note that these parts will be needed."""
        ...

    def need(self, parts: Sequence[Part]) -> None:
        """Note that these parts are needed now; some may still not be ready
        afterwards."""
        ...

    def finish(self, parts: Sequence[Part]) -> None:
        """Return when each part is built, or has failed to build."""
        ...


class AtOnce:
    """Builds parts in the caller's thread as soon as they are needed, and not
    before.

    >>> import numpy as np
    >>> from kille.perception.descriptor_index import View, rooted
    >>> shades = np.random.default_rng(1).integers(0, 255, (40, 128))
    >>> view = View(1, "cup", shades.astype(np.uint8))
    >>> from kille.perception.descriptor_index import Index
    >>> Index([view], builder=AtOnce()).settled().labels
    ('cup',)
    """

    def begin(self, parts: Sequence[Part]) -> None:
        """Do nothing: parts are built when they are needed."""

    def need(self, parts: Sequence[Part]) -> None:
        """Build the parts; raises what building raises."""
        for part in parts:
            part.build()

    def finish(self, parts: Sequence[Part]) -> None:
        """Build the parts."""
        self.need(parts)


class Background:
    """Builds parts in two threads, one of which is kept free of large ones.

    Small parts, which are ready in no time, are waited for when they are needed: up to
    `patience` descriptors answers do not depend on the speed of the machine.
    Threads live while there is something to build, and no part is begun when the
    program is about to end or when nobody holds the part any more.

    >>> import numpy as np
    >>> from kille.perception.descriptor_index import View, rooted
    >>> shades = np.random.default_rng(1).integers(0, 255, (40, 128))
    >>> view = View(1, "cup", shades.astype(np.uint8))
    >>> from kille.perception.descriptor_index import Index
    >>> Index([view], builder=Background()).settled().labels
    ('cup',)
    """

    def __init__(self, patience: int = _PATIENCE) -> None:
        self._patience = patience
        self._small, self._large = _Lane(), _Lane()

    def begin(self, parts: Sequence[Part]) -> None:
        """Queue the parts, the small ones first."""
        for part in sorted(parts, key=lambda part: part.size):
            lane = self._small if part.size <= _QUICK else self._large
            lane.add(part)

    def need(self, parts: Sequence[Part]) -> None:
        """Wait for the small parts, for a limited time."""
        for part in parts:
            if part.size <= self._patience:
                part.wait(_LONG)

    def finish(self, parts: Sequence[Part]) -> None:
        """Wait for the parts; build them here if no thread will."""
        for part in parts:
            while not part.wait(_LONG):
                if not _may_begin():
                    part.build()


class _Lane:
    """A queue of parts, and a thread that builds them while there are any."""

    def __init__(self) -> None:
        self._queue: deque[weakref.ref[Part]] = deque()
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None

    def add(self, part: Part) -> None:
        with self._lock:
            self._queue.append(weakref.ref(part))
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="kille-index")
                self._thread.start()

    def _work(self) -> None:
        while (part := self._next()) is not None:
            _build(part)
            del part  # nobody else may hold it any more

    def _next(self) -> Part | None:
        with self._lock:
            while self._queue and _may_begin():
                part = self._queue.popleft()()
                if part is not None:
                    return part
            self._thread = None
            return None


def _may_begin() -> bool:
    """Is the program still running? At its end it would wait for whatever is begun."""
    return threading.main_thread().is_alive()


def _build(part: Part) -> None:
    try:
        part.build()
    except GoneError:
        return  # nobody will ask any more
    except Exception as error:
        logging.getLogger(__name__).error(
            "an index over %d descriptors could not be built (%r): "
            "the parts that it was to replace stay in use",
            part.size,
            error,
        )
