"""Studies as files: from TOML to a value, or all that is wrong with how it is written.

Whether what it names can be used, `kille.lab.study_files.checking` says.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import fields
from importlib.resources import files
from itertools import count
from os.path import expanduser
from pathlib import Path
from typing import Any

from kille.lab.errors import StudyError
from kille.lab.settings import why_no_file
from kille.lab.study import Named, Phase, Study, Theory
from kille.lab.study_files.problems import format_problems
from kille.lab.study_files.shape import APART, STUDY, shape_problems
from ttr.safety.consent import OWN_FOLDER, Consent
from ttr.safety.files import why_unread
from ttr.safety.inputs import parse_toml, read_text
from ttr.safety.limits import SETTINGS

PACKAGED = Path(str(files("kille.grammars")))
"""Where the theories of the package are, which those of anybody may import."""

_OWN = re.compile(r"\.py(?=:)|\.ttr$")
"""Whether a name is that of something in a file of one's own."""


def read(path: Path, consent: Consent = OWN_FOLDER) -> Study:
    """The study in a file; `StudyError` with a line for each mistake.

    >>> import tempfile
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "teach"
    ... '''
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "cups.toml").write_text(text)
    ...     read(Path(folder, "cups.toml")).title
    'Cups'
    """
    return parse(read_source(path), path, consent)


def parse(text: str, path: Path, consent: Consent = OWN_FOLDER) -> Study:
    """The study of a text that is, or once was, in this file; `StudyError` as `read`.

    Paths in it begin at the folder of the file. Python there, or below, is what it may
    run, and what else there is consent to.

    >>> from pathlib import Path
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "teach"
    ... '''
    >>> [*parse(text, Path("cups.toml")).theories]
    ['plain']
    """
    data = parse_data(text, path)
    if found := [*shape_problems(data)]:
        raise StudyError(format_problems(found, text, path))
    return study_of(data, text, path, consent)


def read_source(path: Path) -> str:
    """Read the text of a file; `StudyError` if there is none."""
    try:
        return read_text(path, SETTINGS)
    except FileNotFoundError as error:
        raise StudyError([why_no_file(path)]) from error
    except (OSError, UnicodeDecodeError) as error:
        raise StudyError([why_unread(path, error)]) from error


def parse_data(text: str, path: Path) -> Mapping[str, Any]:
    """Parse a text; `StudyError` if it is not TOML."""
    try:
        return parse_toml(text)
    except ValueError as error:
        line, why = why_not_toml(text, error)
        raise StudyError([f"{path}:{line}: {why}"]) from error


def study_of(
    data: Mapping[str, Any], text: str, path: Path, consent: Consent = OWN_FOLDER
) -> Study:
    """Make a study of data that has no problems."""
    folder = path.resolve().parent
    allowed = consent.with_folders(folder, PACKAGED)
    seeds = data["seeds"]
    return Study(
        title=data["title"],
        theories={
            name: _read_theory(name, one, folder, allowed)
            for name, one in data["theories"].items()
        },
        tutors={name: _read_named(name, one) for name, one in data["tutors"].items()},
        scenes={name: _read_named(name, one) for name, one in data["scenes"].items()},
        phases=tuple(_read_phases(data["phases"])),
        seeds=tuple(range(1, seeds + 1) if isinstance(seeds, int) else seeds),
        about=data.get("about", "").strip(),
        turns=data.get("turns", STUDY["turns"].default),
        main=data.get("main", STUDY["main"].default),
        contrasts=tuple((one, other) for one, other in data.get("contrasts", ())),
        source=text,
        folder=folder,
        file=path,
        consent=allowed,
    )


def _read_theory(
    name: str, given: Mapping[str, Any], folder: Path, consent: Consent
) -> Theory:
    known = {one.name for one in fields(Theory)} - {"consent"}
    values = {key: value for key, value in given.items() if key in known and value}
    if "without" in values:
        values["without"] = tuple(values["without"])
    if "rules" in values:
        values["rules"] = _resolve_name(values["rules"], folder)
    if isinstance(values.get("meanings"), str):
        values["meanings"] = str(_resolve_path(values["meanings"], folder))
    if "grammar" in values:
        values["grammar"] = _resolve_path(values["grammar"], folder)
    if "learners" in values:
        own = values["learners"].items()
        values["learners"] = {kind: _resolve_name(one, folder) for kind, one in own}
    return Theory(name, consent=consent, **values)


def _resolve_name(reference: str, folder: Path) -> str:
    """The full path of a name in the user's own file; other names as they are."""
    return (
        str(_resolve_path(reference, folder)) if _OWN.search(reference) else reference
    )


def _resolve_path(name: str, folder: Path) -> Path:
    return folder / expanduser(name)


def _read_named(name: str, given: Mapping[str, Any]) -> Named:
    settings = {key: value for key, value in given.items() if key != "kind"}
    return Named(name, given["kind"], settings)


def _read_phases(given: list[Mapping[str, Any]]) -> Iterator[Phase]:
    """The phases, each with a name of its own."""
    taken: set[str] = set()
    for one in given:
        wanted = one.get("name") or one["do"]
        names = (wanted if n == 1 else f"{wanted} {n}" for n in count(1))
        name = next(it for it in names if it not in taken)
        taken.add(name)
        settings = {k: value for k, value in one.items() if k not in APART["do"]}
        yield Phase(name, one["do"], settings)


# --- what is no TOML ------------------------------------------------------------------

_SEE = "see https://toml.io"

_SLIPS = (
    (re.compile("=\\s*[“”„«»‘’]"), 'a text is put between straight quotes, "…"'),
    (re.compile(r"=\s*(True|False)\b"), "write true or false, in small letters"),
    (re.compile(r"=\s*(?!(true|false|nan|inf)\b)[^\W\d]"), 'a text has quotes, "…"'),
    (re.compile(r"=\s*\.\d"), "a number begins with a digit, 0.1"),
    (re.compile(r"=\s*\d+,\d+"), "a number has a point, 0.1"),
    (re.compile(r"^\s*[\w-]+\s*:"), "write KEY = VALUE"),
)
"""What somebody has probably written on a line that is wrong, and what to write."""


def why_not_toml(text: str, error: Exception) -> tuple[int, str]:
    """The line at which a text is not TOML, and why.

    Python 3.11 has the place of a mistake only in its message.
    """
    what, _, place = str(error).partition(" (at ")
    lines = text.split("\n")
    found = re.search(r"line (\d+)", place)
    number = int(found[1]) if found else text.removesuffix("\n").count("\n") + 1
    line = lines[number - 1] if number <= len(lines) else ""
    return number, f"this is no TOML: {_plain_reason(what, line, text)}"


def _plain_reason(what: str, line: str, text: str) -> str:
    """The parser's message in plain words, with a hint."""
    if what == "Cannot overwrite a value" and "=" in line:
        return f"{line.partition('=')[0].strip()} is there twice"
    header = re.match(r"\s*\[+\s*([^\]]+?)\s*\]", line)
    if header and what.startswith("Cannot "):
        return _twice(header[1], text)
    if what.startswith("Cannot mutate"):
        return "it adds to what is whole, between { and }: write it in there"
    slips = (hint for slip, hint in _SLIPS if slip.search(line))
    return f"{what[:1].lower()}{what[1:]}; {next(slips, _SEE)}"


def _twice(table: str, text: str) -> str:
    """The message for a table that is declared twice."""
    several = f"[[{table}]]"
    if several in text:
        return f"[{table}] is there beside {several}: write {several} each time"
    return f"[{table}] is there twice"
