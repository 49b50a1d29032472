"""Packages that the default install leaves out, and what to say where one is needed."""

from __future__ import annotations

from importlib.util import find_spec

NEEDED = {
    "experiments": {"scipy": "SciPy", "sklearn": "scikit-learn", "joblib": "joblib"}
}
"""The modules without which an extra's uses are refused, with what people call them."""


class MissingExtraError(Exception):
    """The packages of an extra are not installed, or are not those that are needed;
    one line says what to install.

    >>> raise MissingExtraError("pip install 'kille[embedding]'")
    Traceback (most recent call last):
        ...
    kille.extras.MissingExtraError: pip install 'kille[embedding]'
    """


def check_extra(extra: str, use: str) -> None:
    """Raise `MissingExtraError` where the packages of an extra are not installed.

    The message says that `use` needs them. Nothing is imported.

    >>> check_extra("experiments", "a study")
    """
    missing = [name for it, name in NEEDED[extra].items() if find_spec(it) is None]
    if missing:
        told = f"{use} needs {', '.join(missing)}: pip install 'kille[{extra}]'"
        raise MissingExtraError(told)
