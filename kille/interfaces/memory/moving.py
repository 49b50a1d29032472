"""`kille memory export` and `import`: a memory as files, and back."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
from pathlib import Path

from kille.interfaces.terminal import FINE, complain, console, memory_path, print_json
from kille.memory import Memory, MemoryFileError
from kille.memory.exporting import export
from kille.memory.importing import open_package
from kille.memory.packages import PackageError

Report = Callable[[str, Mapping[str, int]], None]
"""How it is told what was done, with how much of what."""


def export_memory(given: Path | None, target: Path, report: Report) -> int:
    """Writes the memory as a zip or a folder; the exit code."""
    path = memory_path(given)
    try:
        with Memory.reading(path) as memory:
            amount = export(memory, target)
    except (MemoryFileError, PackageError) as error:
        return complain(error)
    report(f"{target} holds {path}", asdict(amount))
    return FINE


def import_memory(given: Path | None, source: Path, report: Report) -> int:
    """Adds what is new in an exported memory; the exit code."""
    path = memory_path(given)
    try:
        with open_package(source) as package, Memory.open(path) as memory:
            gained = memory.merge(package)
    except (MemoryFileError, PackageError) as error:
        return complain(error)
    counts = {"dialogues": gained.dialogues, "turns": gained.turns}
    counts |= {"lessons": len(gained.lessons), "lessons_known": gained.known}
    report(f"{path} learned from {source}", counts)
    return FINE


def as_json(_: str, amounts: Mapping[str, int]) -> None:
    """The amounts, for machines."""
    print_json(dict(amounts))


def as_text(done: str, amounts: Mapping[str, int]) -> None:
    """The amounts, for people."""
    console().print(f"{done}: {listed(amounts)}", markup=False)


def listed(amounts: Mapping[str, int]) -> str:
    """The amounts as a list: 1 dialogue, 6 turns."""
    return ", ".join(_amount(what, count) for what, count in amounts.items())


def _amount(what: str, count: int) -> str:
    if what == "lessons_known":
        return f"{count} known before"
    return f"{count} {what[:-1] if count == 1 else what}"
