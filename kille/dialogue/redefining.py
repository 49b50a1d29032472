"""The types of the dialogue: those of `grammars/tutor.ttr`, or others in their place.

All states, rules and words of a process are made of them when it begins, so which they
are is said from outside, by a variable.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from importlib.resources import files

from ttr import Theory, TTRError
from ttr.errors import suggestion
from ttr.safety.consent import check_called
from ttr.theories.theory import load

VARIABLE = "KILLE_THEORY"
"""The variable of a process that has other types."""

ALLOWED = "KILLE_ALLOW"
"""The variable that names folders from which these may import, with colons between."""

SOURCE = "tutor.ttr"

_STATEMENT = r"\s*:=.*(\n[ \t\])]+.*)*"
"""What follows the name in a definition, which may go on over indented lines."""


def types_of(own: str = "", allowed: str = "") -> Theory:
    """The theory of the dialogue, by what the variables say.

    Nothing: as packaged. An object of JSON: some types are defined so instead. Else it
    is a file in place of the packaged one. Raises `TTRError` for what is no theory.
    """
    if own and not own.startswith("{"):
        check_called(own, ".ttr")
        return load(own, allow=filter(None, allowed.split(os.pathsep)))
    text = files("kille.grammars").joinpath(SOURCE).read_text(encoding="utf-8")
    return Theory.parse(redefined(text, json.loads(own or "{}")), SOURCE)


def redefined(text: str, types: Mapping[str, str]) -> str:
    r"""A theory file in which some types are defined otherwise, each on one line.

    All else stays on its line. Raises `TTRError` for a name that it does not define.

    >>> redefined("A := [x : Ind,\n      y : Ind]\nB := A", {"A": "[x : Ind]"})
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
