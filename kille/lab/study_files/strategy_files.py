"""Files of strategies tried: what of one's own `strategies.toml` cannot be used."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping
from typing import Any

from kille.dialogue.language_files import STRATEGIES, read_table
from kille.dialogue.strategies import strategy
from kille.lab.settings import Key, Problem, show_value
from kille.lab.study import Theory
from kille.lab.study_files.problems import line_of, lines_of
from kille.lab.theories.games import language_of
from ttr.errors import suggestion
from ttr.safety.files import why_unread
from ttr.safety.inputs import read_text
from ttr.safety.limits import SETTINGS

_KEY: Key = ("grammar",)

_NAMED = ("wordings", "modes", "turns")
"""The tables whose entries may have names of one's own."""

_ODD = (ValueError, TypeError, AttributeError, LookupError)
"""What becomes of tables that are not what strategies are made of."""


def strategy_file_problems(theory: Theory) -> Iterator[Problem]:
    """What is wrong with a file of strategies in a theory's own folder."""
    if theory.grammar is None or not (theory.grammar / STRATEGIES).is_file():
        return
    file = theory.grammar / STRATEGIES
    try:
        text = read_text(file, SETTINGS)
        own = read_table(STRATEGIES, language_of(theory))
    except tomllib.TOMLDecodeError as error:
        found = re.search(r"line (\d+)", str(error))
        at = f"{file}:{found[1] if found else 1}"
        yield Problem(_KEY, f"these strategies are no TOML: {error}", at)
        return
    except (OSError, UnicodeDecodeError) as error:
        yield Problem(_KEY, why_unread(file.name, error), f"{file}:1")
        return
    except ValueError as error:
        yield Problem(_KEY, f"these strategies do not read: {error}", f"{file}:1")
        return
    lines = lines_of(text)
    wrong = [*_setting_problems(own, _model(), ())]
    for key, what in wrong:
        yield Problem(_KEY, what, f"{file}:{line_of(lines, key)}")
    if wrong:
        return
    try:
        strategy(theory.mode, theory.wording, language_of(theory))
    except KeyError as error:
        told = f"these strategies lack {error.args[0]}, which those of the package have"
        yield Problem(_KEY, told, f"{file}:1")
    except _ODD as error:
        yield Problem(_KEY, f"these strategies cannot be used: {error}", f"{file}:1")


def _model() -> dict[str, Any]:
    """The packaged strategies, with all that may stand in an entry of one's own."""
    model = dict(read_table(STRATEGIES, "en"))
    for table in _NAMED:
        model[table] = _merge(*model[table].values())
    model["wordings"]["like"] = ""
    return model


def _merge(*tables: Mapping[str, Any]) -> dict[str, Any]:
    merged: dict[str, Any] = {}
    for table in tables:
        merged |= table
    return merged


def _setting_problems(
    own: Mapping[str, Any], model: Mapping[str, Any], outer: Key
) -> Iterator[tuple[Key, str]]:
    """What is in a table that cannot stand there, by the place where it is."""
    for name, value in own.items():
        key = (*outer, name)
        if name not in model:
            where = ".".join(map(str, outer))
            hint = suggestion(name, model)
            told = f"{where or 'a file of strategies'} has no {name}"
            yield key, told + f": {hint}" * bool(hint)
        elif key in [(it,) for it in _NAMED] and isinstance(value, Mapping):
            for entry, inner in value.items():
                here = (*key, entry)
                yield from _value_problems(inner, model[name], here)
        else:
            yield from _value_problems(value, model[name], key)


def _value_problems(value: Any, usual: Any, key: Key) -> Iterator[tuple[Key, str]]:
    path = ".".join(map(str, key))
    if isinstance(usual, Mapping) and isinstance(value, Mapping):
        yield from _setting_problems(value, usual, key)
    elif isinstance(usual, Mapping):
        yield key, f"{path}: expected a table, found {show_value(value)}"
    elif isinstance(usual, str) != isinstance(value, str):
        expected = "a name" if isinstance(usual, str) else "a number"
        yield key, f"{path}: expected {expected}, found {show_value(value)}"
