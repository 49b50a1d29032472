"""Names that something had until the last release: they still work, and warn.

>>> class Dog:
...     sound = "woof"
...     noise = Alias("sound")
>>> import warnings
>>> with warnings.catch_warnings(record=True) as said:
...     warnings.simplefilter("always")
...     Dog().noise
'woof'
>>> print(said[0].message)
Dog.noise is now Dog.sound
"""

from __future__ import annotations

from typing import Any
from warnings import warn

__all__ = ["Alias"]


class Alias:
    """A former name of an attribute or a method."""

    def __init__(self, now: str) -> None:
        self.now = now

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, instance: object, owner: type) -> Any:
        """The value under the name it has now.

        >>> Alias("sound").now
        'sound'
        """
        which = owner.__name__
        message = f"{which}.{self.name} is now {which}.{self.now}"
        warn(message, DeprecationWarning, stacklevel=2)
        return getattr(owner if instance is None else instance, self.now)
