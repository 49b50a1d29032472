"""What a log is of: the study, what it names, and what its dialogues are played by."""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path

from kille.lab.log.outcomes import RunError
from kille.lab.log.schema import check_ours
from kille.lab.log.sources import changed_sources, sources
from kille.lab.study import Study
from kille.lab.versions import versions


@dataclass(frozen=True)
class About:
    """What a log is of: the study, how many dialogues it has, and what made them.

    >>> made = About("Cups", "", Path("cups.toml"), 4, "2026-01-31 12:00", {}, {})
    >>> made.title, made.planned
    ('Cups', 4)
    """

    title: str
    source: str
    """The text of the study."""
    file: Path
    """Where the text is from; the paths in it begin in its folder."""
    planned: int
    began: str
    versions: Mapping[str, str]
    sources: Mapping[str, str]
    """The digests of the study and of the files that it names."""


def about_rows(study: Study, folder: Path) -> dict[str, str]:
    """The rows of a new log's table `about`."""
    return {
        "title": study.title,
        "source": study.source,
        "folder": os.path.relpath(study.folder.resolve(), folder.resolve()),
        "file": study.file.name,
        "planned": str(sum(1 for _ in study.runs())),
        "began": datetime.now(UTC).isoformat(timespec="seconds"),
        "versions": json.dumps(versions()),
        "sources": json.dumps(sources(study)),
    }


def about_in(connection: sqlite3.Connection, folder: Path) -> About:
    """Read what a log is of; RunError if it is not a log."""
    check_ours(connection, folder)
    found = dict(connection.execute("SELECT name, value FROM about"))
    return About(
        found["title"],
        found["source"],
        Path(os.path.normpath(folder.resolve() / found["folder"]), found["file"]),
        int(found["planned"]),
        found["began"],
        json.loads(found["versions"]),
        json.loads(found["sources"]),
    )


def check_same(before: About, study: Study, folder: Path) -> None:
    """Refuse to mix dialogues of different studies in one log."""
    differs = changed_sources(before.sources, sources(study))
    if differs:
        raise RunError(
            f"{folder} has dialogues of another study: {differs[0]} has changed since; "
            f"name another folder with --out, or put it back as it was"
        )
    if (found := version("kille")) != before.versions["kille"]:
        raise RunError(
            f"{folder} was begun with kille {before.versions['kille']}, and this is "
            f"{found}: name another folder with --out, or go on with that one"
        )
