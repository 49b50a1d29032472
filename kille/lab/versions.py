"""The versions of the software that plays and measures here."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version

_PACKAGES = ("kille", "numpy", "scikit-learn", "opencv-contrib-python-headless")


def versions() -> dict[str, str]:
    """The versions of Python and of the packages that numbers may depend on.

    A package that is not installed, as where its files are only on the path, has none.
    """
    found = {"python": platform.python_version()}
    for package in _PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found
