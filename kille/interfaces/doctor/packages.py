"""Whether the packages are there that this distribution requires, and its extras."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from importlib.metadata import PackageNotFoundError, metadata, requires, version

from kille.interfaces.doctor.finding import Finding

__all__ = ["extras", "packages"]


def packages() -> Iterator[Finding]:
    """The packages that are always needed."""
    for requirement in _required(""):
        name = _name(requirement)
        found = _installed(name)
        if found is not None:
            yield Finding(name, True, True, found)
        else:
            remedy = f"pip install '{requirement}'"
            yield Finding(name, False, True, "not installed", remedy)


def extras() -> Iterator[Finding]:
    """The packages that only some uses need, such as drawing or testing."""
    for extra in metadata("kille").get_all("Provides-Extra") or ():
        yield _extra(extra)


def _extra(extra: str) -> Finding:
    part = f"extra [{extra}]"
    wanted = [it for it in _required(extra) if _name(it) != "kille"]
    missing = [it for it in wanted if _installed(_name(it)) is None]
    if not missing:
        return Finding(part, True, False, ", ".join(map(_name, wanted)))
    state = f"not installed are {', '.join(map(_name, missing))}"
    return Finding(part, False, False, state, f"pip install {_quoted(missing)}")


def _required(extra: str) -> list[str]:
    """What this distribution requires, plainly or for an extra, as pip writes it."""
    parted = [line.partition(";") for line in requires("kille") or ()]
    return [
        requirement.strip()
        for requirement, _, marker in parted
        if re.findall(r"extra == ['\"](\w+)['\"]", marker) == ([extra] if extra else [])
    ]


def _quoted(words: Iterable[str]) -> str:
    return " ".join(f"'{word}'" for word in words)


def _name(requirement: str) -> str:
    return re.split(r"[^\w.-]", requirement, maxsplit=1)[0]


def _installed(name: str) -> str | None:
    """The version of a package, or None."""
    try:
        return version(name)
    except PackageNotFoundError:
        return None
