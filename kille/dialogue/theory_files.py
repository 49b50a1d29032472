"""Theories of the dialogue from files: `grammars/tutor.ttr`, or others in its place."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cache
from importlib.resources import files
from pathlib import Path

from kille.dialogue.theory_cache import recall_theory
from ttr import Theory, TTRError
from ttr.errors import suggestion
from ttr.safety.consent import check_called
from ttr.theories.theory import load

SOURCE = "tutor.ttr"

_STATEMENT = r"\s*:=.*(\n[ \t\])]+.*)*"
"""What follows the name in a definition, which may go on over indented lines."""


@cache
def packaged_theory() -> Theory:
    """The theory of the packaged `tutor.ttr`."""
    return recall_theory(_packaged_text(), SOURCE)


def theory_with(types: Mapping[str, str]) -> Theory:
    """The packaged theory with other definitions of some types.

    Raises `TTRError` for a name that it does not define, and for a text that is no
    type.

    >>> print(theory_with({"Phrase": "[look : Look, x : Ind, y : Ind]"}).Phrase)
    [look : Look, x : Ind, y : Ind]
    """
    return Theory.parse(redefine(_packaged_text(), types), SOURCE)


def _packaged_text() -> str:
    return files("kille.grammars").joinpath(SOURCE).read_text(encoding="utf-8")


def theory_of_file(file: Path | str, allow: Iterable[Path | str] = ()) -> Theory:
    """The theory of a file that takes the place of the packaged one.

    It may import from its folder, and from those that `allow` names. Raises `TTRError`
    for what is no theory.
    """
    check_called(str(file), ".ttr")
    return load(file, allow=allow)


def redefine(text: str, types: Mapping[str, str]) -> str:
    r"""A theory file with other definitions of some types, each on one line.

    Everything else stays on its line. Raises `TTRError` for a name that it does not
    define.

    >>> redefine("A := [x : Ind,\n      y : Ind]\nB := A", {"A": "[x : Ind]"})
    'A := [x : Ind]\n\nB := A'
    """
    for name, definition in types.items():
        statement = re.search(rf"^{re.escape(name)}{_STATEMENT}", text, re.M)
        if statement is None:
            known = re.findall(r"^(\w+)\s*:=", text, flags=re.M)
            raise TTRError(f"{SOURCE} defines no {name}", hint=suggestion(name, known))
        lines = "\n" * statement[0].count("\n")
        new = f"{name} := {' '.join(definition.split())}{lines}"
        text = text[: statement.start()] + new + text[statement.end() :]
    return text
