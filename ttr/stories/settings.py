"""What a story is played in: the game that it names, and the names that it may use."""

from __future__ import annotations

import importlib
import os
import re
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Self

from ttr.errors import TTRError, suggestion
from ttr.models import Model
from ttr.modules import run_file
from ttr.notation.loading import Unreadable
from ttr.notation.reader import read
from ttr.stories.reading import StoryError
from ttr.syntax import Basic, Object, Rec, TypeNode, Universe
from ttr.theories import Theory, load
from ttr.updates import Game

__all__ = ["Setting", "setting"]

_WRITTEN = "FILE.ttr NAME, FILE.py:NAME or MODULE:NAME"


@dataclass(frozen=True, eq=False)
class Setting:
    """A game, the theory whose names are used in its stories, and how it is named.

    `reference` is what stands after `@ game` in a story in this folder; it may be
    empty.
    """

    game: Game
    theory: Theory
    reference: str = ""
    folder: Path = Path()

    @classmethod
    def of(cls, game: Game, theory: Theory | None = None, reference: str = "") -> Self:
        """The setting of a game; without a theory, what occurs in it can be named."""
        return cls(game, theory or game.theory or _mentioned(game), reference)

    def reference_from(self, folder: Path) -> str:
        """What stands after `@ game` in another folder."""
        file, rest = _parts(self.reference)
        if not file or Path(file).is_absolute():
            return self.reference
        moved = os.path.relpath(self.folder / file, folder)
        return Path(moved).as_posix() + rest

    def value(self, text: str, model: Model, source: str = "<text>") -> Object:
        """The type or object that a text stands for, among what the model knows."""
        known = (name for name in model.facts.known if isinstance(name, str))
        names = self.theory.objects.union(known)
        value = read(text, replace(self.theory, objects=names), source)
        return model.reduced(value)


def setting(reference: str, folder: Path) -> Setting:
    """The setting that a reference names; a file is taken from the folder.

    A reference is the path of a theory and the name of a game in it, or a Python file
    or module, a colon and a name. Raises `StoryError` where nothing is named so.
    """
    file, rest = _parts(reference)
    if file.endswith(".ttr"):
        found = _of_theory(file, rest.strip(), folder)
    else:
        module, _, name = reference.rpartition(":")
        if not module or not name.strip():
            raise StoryError(f"a game is named as {_WRITTEN}, found {reference!r}")
        found = _of_python(module.strip(), name.strip(), folder)
    return replace(found, reference=reference, folder=folder)


def _parts(reference: str) -> tuple[str, str]:
    """The file that a reference names, if it names one, and what follows it."""
    found = re.fullmatch(r"(.+?\.ttr|.+\.py(?=:))((?: +\S+)?|:.*)", reference)
    return (found[1], found[2]) if found else ("", reference)


def _of_theory(file: str, name: str, folder: Path) -> Setting:
    _check_there(file, folder)
    try:
        theory = load(folder / file)
        games = theory.games
    except Unreadable as error:
        raise StoryError(error.message) from error
    except TTRError as error:
        place = f"{error.span.source}:{error.span.line}: " if error.span else ""
        raise StoryError(f"{file} cannot be read: {place}{error.message}") from error
    if not name and len(games) == 1:
        (name,) = games
    if name not in games:
        raise StoryError(_no_game(file, name, tuple(games)))
    return Setting(games[name], theory)


def _of_python(path: str, name: str, folder: Path) -> Setting:
    module = _module(path, folder)
    games = {key: one for key, one in vars(module).items() if isinstance(one, Game)}
    if name not in games:
        raise StoryError(_no_game(path, name, tuple(games)))
    game = games[name]
    theory = game.theory or _defined(module, _mentioned(game))
    return Setting(game, theory)


def _check_there(file: str, folder: Path) -> None:
    path = folder / file
    if path.is_file():
        return
    beside = [one.name for one in path.parent.glob(f"*{path.suffix}")]
    near = suggestion(path.name, beside)
    raise StoryError(f"there is no file {file}" + f": {near}" * bool(near))


def _no_game(file: str, name: str, known: tuple[str, ...]) -> str:
    told = f"{file} has no game {name}" if name else f"name a game of {file}"
    if not known:
        return f"{told}: there is none in it"
    return f"{told}: {suggestion(name, known) or 'it has ' + ', '.join(known)}"


# --- games in Python -----------------------------------------------------------------


def _module(path: str, folder: Path) -> ModuleType:
    """The module of a file or a dotted name, run if it has not been."""
    is_file = path.endswith(".py")
    if is_file:
        _check_there(path, folder)
    try:
        if not is_file:
            return importlib.import_module(path)
        return run_file(folder / path, f"_played_{Path(path).stem}")
    except StoryError:
        raise
    except Exception as error:
        raise StoryError(_not_run(path, error)) from error


def _not_run(path: str, error: Exception) -> str:
    if isinstance(error, ModuleNotFoundError) and error.name in _with_parents(path):
        return f"there is no module {path}: name a game as {_WRITTEN}"
    fault = f"{type(error).__name__}: {error}".splitlines()[0]
    return f"{path} cannot be run: {fault}"


def _with_parents(module: str) -> list[str]:
    """A dotted name and those of the packages that it is in: a.b.c, a.b and a."""
    return [".".join(module.split(".")[: n + 1]) for n in range(module.count(".") + 1)]


def _mentioned(game: Game) -> Theory:
    """The theory that declares what occurs in a game."""
    types = [T for rule in game.rules for T in (rule.when, rule.on, rule.gives)]
    planned = [T for T in types if T is not None]
    return Theory.of(game.type, game.start, *game.hears, *planned)


def _defined(module: ModuleType, theory: Theory) -> Theory:
    """The theory in which the types of a module have their names in it, too."""
    definitions = {
        name: T
        for name, T in vars(module).items()
        if isinstance(T, TypeNode)
        and not isinstance(T, Basic | Universe)
        and T is not Rec
    }
    mentioned = (*theory.basics.values(), *theory.predicates.values())
    wider = Theory.of(*mentioned, *definitions.values(), *sorted(theory.objects))
    return replace(wider, definitions=definitions)
