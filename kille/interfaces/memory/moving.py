"""`kille memory export` and `import`: write a memory to files, and read it back."""

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
"""Reports what was done, with the amounts."""


def export_memory(given: Path | None, target: Path, report: Report) -> int:
    """Write the memory as a zip or a folder; returns the exit code."""
    path = memory_path(given)
    try:
        with Memory.open_to_read(path) as memory:
            amount = export(memory, target)
    except (MemoryFileError, PackageError) as error:
        return complain(error)
    report(f"{target} holds {path}", asdict(amount))
    return FINE


def import_memory(given: Path | None, source: Path, report: Report) -> int:
    """Add what is new in an exported memory; returns the exit code."""
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
    """Print the amounts, for machines."""
    print_json(dict(amounts))


def as_text(done: str, amounts: Mapping[str, int]) -> None:
    """Print the amounts, for people."""
    console().print(f"{done}: {list_amounts(amounts)}", markup=False)


def list_amounts(amounts: Mapping[str, int]) -> str:
    """The amounts as a list: 1 dialogue, 6 turns."""
    return ", ".join(_amount(what, count) for what, count in amounts.items())


def _amount(what: str, count: int) -> str:
    if what == "lessons_known":
        return f"{count} known before"
    return f"{count} {what[:-1] if count == 1 else what}"
