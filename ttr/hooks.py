"""Operations declared on the ground floor, and provided by the floor that does them.

`str(T)`, `S <= T` and `T._repr_html_()` each stand for one thing that needs far more
than the class they are written on. The class declares the operation; the module that
does the work provides it, so that imports go one way. `import ttr` says which module
provides what (`PROVIDERS` there), and each is loaded when its operation is first used.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import update_wrapper
from importlib import import_module
from typing import Generic, ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")

_PROVIDERS: dict[str, str] = {}


class Hook(Generic[P, R]):
    """An operation that a module above provides: `operation.provided_by(function)`."""

    def __init__(self, declaration: Callable[P, R]) -> None:
        update_wrapper(self, declaration)
        self.name = f"{declaration.__module__}.{declaration.__qualname__}"
        self._function: Callable[P, R] = self._load

    def provided_by(self, function: Callable[P, R]) -> Callable[P, R]:
        """Has this function do it from now on; as a decorator it leaves it as it is."""
        self._function = function
        return function

    def __call__(self, *args: P.args, **named: P.kwargs) -> R:
        """What the function that does it gives."""
        return self._function(*args, **named)

    def _load(self, *args: P.args, **named: P.kwargs) -> R:
        if self.name in _PROVIDERS:
            import_module(_PROVIDERS[self.name])
        if self._function == self._load:
            raise NotImplementedError(f"nothing provides {self.name}")
        return self._function(*args, **named)


def hook(declaration: Callable[P, R]) -> Hook[P, R]:
    """Declares an operation; the body of the function is never run.

    >>> @hook
    ... def double(n: int) -> int:
    ...     raise NotImplementedError
    >>> @double.provided_by
    ... def _twice(n: int) -> int:
    ...     return 2 * n
    >>> double(4)
    8
    """
    return Hook(declaration)


def set_providers(modules: Mapping[str, str]) -> None:
    """From now on, the operations with these names are provided by these modules."""
    _PROVIDERS.update(modules)
