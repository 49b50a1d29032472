"""`kille memory check`: report what is wrong with a memory, and salvage the rest."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path

from kille.interfaces.memory.moving import list_amounts
from kille.interfaces.terminal import (
    FAILED,
    FINE,
    complain,
    console,
    memory_path,
    print_json,
)
from kille.memory import MemoryFileError
from kille.memory.checking import MemoryCheck, check
from kille.memory.salvaging import Salvage, salvage

Report = Callable[[Path, MemoryCheck, Path | None, Salvage | None], None]
"""Reports what is wrong with a file, and what was saved to where."""


def check_memory(given: Path | None, target: Path | None, report: Report) -> int:
    """Check a memory; returns 1 if anything is wrong, or is not saved.

    With a target, a new memory there gets what can be saved.
    """
    path = memory_path(given)
    try:
        health = _health(path, may_be_lost=target is not None)
        saved = None if target is None else salvage(path, target)
    except MemoryFileError as error:
        return complain(error)
    report(path, health, target, saved)
    return FAILED if health.faults or (saved and saved.losses) else FINE


def _health(path: Path, *, may_be_lost: bool) -> MemoryCheck:
    """The health of a file, also of one that is no memory any more."""
    try:
        return check(path)
    except MemoryFileError as error:
        if not may_be_lost or not path.is_file():
            raise
        fault = str(error).removeprefix(f"{path} ").partition(":")[0]
        return MemoryCheck((f"it {fault}",), (), None)


def as_json(
    path: Path, health: MemoryCheck, target: Path | None, saved: Salvage | None
) -> None:
    """Print what is wrong and what was saved, for machines."""
    facts: dict[str, object] = {
        "file": str(path),
        "sound": not health.faults,
        "faults": health.faults,
        "notes": health.notes,
        "holds": None if health.amount is None else asdict(health.amount),
    }
    if saved is not None:
        facts["salvaged"] = {"file": str(target), **_saved_counts(saved)}
        facts["losses"] = saved.losses
    print_json(facts)


def as_text(
    path: Path, health: MemoryCheck, target: Path | None, saved: Salvage | None
) -> None:
    """Print what is wrong and what was saved, for people."""
    _print(f"{path} {_in_brief(health)}")
    for line in (*health.faults, *health.notes):
        _print(f"  {line}")
    if saved is not None:
        _print(
            f"{target} holds what could be saved: {list_amounts(_saved_counts(saved))}"
        )
        for line in saved.losses:
            _print(f"  lost: {line}")
    elif health.faults:
        way = f"kille memory check {shlex.quote(str(path))} --salvage NEW.db"
        _print(f"{way} makes a new memory of what can be read.")


def _in_brief(health: MemoryCheck) -> str:
    if health.amount is not None:
        return f"is sound: {list_amounts(asdict(health.amount))}"
    return f"has {len(health.faults)} fault{'s' * (len(health.faults) != 1)}:"


def _saved_counts(saved: Salvage) -> dict[str, int]:
    gained = saved.saved
    return {
        "dialogues": gained.dialogues,
        "turns": gained.turns,
        "lessons": len(gained.lessons),
    }


def _print(line: str) -> None:
    console().print(line)
