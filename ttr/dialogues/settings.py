"""The setting of a dialogue: the game that is named, and the names it may use."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Self

from ttr.errors import TTRError, suggestion
from ttr.judging.models import Model
from ttr.notation.reader import read_term
from ttr.safety.consent import OWN_FOLDER, Consent, NotAllowedError, check_called
from ttr.safety.python_files import run_named
from ttr.theories.loading import ReadText, UnreadableError, read_theory_text
from ttr.theories.theory import Theory, theory_of_file
from ttr.types.objects import Object
from ttr.types.syntax import Basic, Rec, TypeNode, Universe
from ttr.updates import Game

_WRITTEN = "FILE.ttr NAME, FILE.py:NAME or MODULE:NAME"


class StoryError(TTRError):
    """A dialogue file that cannot be read or played: where, and why.

    >>> from ttr.dialogues.stories import Line
    >>> line = Line("a.dlg", 3, "S>", "Hello.", written="S> Hello.")
    >>> raise line.wrong("nobody has spoken yet")
    Traceback (most recent call last):
        ...
    ttr.dialogues.settings.StoryError: a.dlg:3: nobody has spoken yet
    """


@dataclass(frozen=True, eq=False)
class Setting:
    """A game, the theory whose names its stories use, and the reference to the game.

    `reference` is what stands after `@ game` in a story in this `folder`; it may be
    empty. `consent` is what the user lets the game's files use.

    >>> from ttr import Theory
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> notes = Setting.of(theory.games["notes"], theory, "notes.ttr notes")
    >>> print(notes.value("ann", notes.game.model), "in", notes.reference)
    ann in notes.ttr notes
    """

    game: Game
    theory: Theory
    reference: str = ""
    folder: Path = Path()
    consent: Consent = OWN_FOLDER

    @classmethod
    def of(cls, game: Game, theory: Theory | None = None, reference: str = "") -> Self:
        """The setting of a game; by default, all that occurs in the game has a name."""
        return cls(game, theory or game.theory or _mentioned_theory(game), reference)

    def reference_from(self, folder: Path) -> str:
        """The reference, as seen from another folder."""
        file, rest = _file_and_rest(self.reference)
        if not file or Path(file).is_absolute():
            return self.reference
        moved = os.path.relpath(self.folder / file, folder)
        return Path(moved).as_posix() + rest

    def value(self, text: str, model: Model, source: str = "<text>") -> Object:
        """The type or object that a text stands for, also by names the model knows."""
        known = (name for name in model.facts.known if isinstance(name, str))
        names = self.theory.objects.union(known)
        value = read_term(text, replace(self.theory, objects=names), source)
        return model.reduce(value)


def setting(
    reference: str,
    folder: Path,
    consent: Consent | None = None,
    read: ReadText = read_theory_text,
) -> Setting:
    """The setting that a reference names; its file is relative to the folder.

    A reference is the path of a theory and the name of a game in it, or a Python file
    or module, a colon and a name. Without `consent`, the caller names it, and so lets
    it run; for a reference from a file, pass the user's consent. `read` reads the text
    of a theory. Raises `StoryError` where there is no such game, and `NotAllowedError`
    where there is no consent.

    >>> import tempfile
    >>> text = '''
    ...     basic Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... '''
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "notes.ttr").write_text(text)
    ...     setting("notes.ttr notes", Path(folder)).game.name
    'notes'
    """
    if consent is not None:
        check_named(reference, folder, consent)
    file, rest = _file_and_rest(reference)
    if file.endswith(".ttr"):
        name = rest.strip().removeprefix(":")
        found = _of_theory(file, name, folder, consent or OWN_FOLDER, read)
    else:
        found = _of_python(*_module_and_name(reference), folder, consent)
    named = consent or OWN_FOLDER
    return replace(found, reference=reference, folder=folder, consent=named)


def check_named(reference: str, folder: Path, consent: Consent) -> None:
    """Raises `NotAllowedError` for a reference in a file without consent to it.

    A theory may lie anywhere, for nothing in it is run.
    """
    python = python_in(reference)
    if python:
        consent.check_python(python, folder)
    else:
        file, _ = _file_and_rest(reference)
        check_called(folder / file, ".ttr", file)


def named_by_user(reference: str, folder: Path, consent: Consent) -> Consent:
    """The consent of a user who names a game, and so lets its Python run.

    >>> from ttr.safety.consent import OWN_FOLDER
    >>> named_by_user("door.ttr door", Path(), OWN_FOLDER) == OWN_FOLDER
    True
    """
    python = python_in(reference)
    return consent.with_python(python, folder) if python else consent


def python_in(reference: str) -> str:
    """The Python file or module that a reference names; empty for a theory.

    >>> python_in("games.py:door"), python_in("door.ttr door")
    ('games.py', '')
    """
    if _file_and_rest(reference)[0].endswith(".ttr"):
        return ""
    return _module_and_name(reference)[0]


def theory_in(reference: str) -> str:
    """The theory file that a reference names; empty for a game in Python.

    >>> theory_in("games/door.ttr door"), theory_in("games.py:door")
    ('games/door.ttr', '')
    """
    file = _file_and_rest(reference)[0]
    return file if file.endswith(".ttr") else ""


def _module_and_name(reference: str) -> tuple[str, str]:
    """The Python file or module that a reference names, and the name of its game."""
    python, _, name = reference.rpartition(":")
    if not python or not name.strip():
        raise StoryError(f"a game is named as {_WRITTEN}, found {reference!r}")
    return python.strip(), name.strip()


def _file_and_rest(reference: str) -> tuple[str, str]:
    """The file that a reference names, or an empty text, and the rest of it."""
    found = re.fullmatch(r"(.+?\.ttr|.+\.py(?=:))((?: +\S+)?|:.*)", reference)
    return (found[1], found[2]) if found else ("", reference)


def _of_theory(
    file: str, name: str, folder: Path, consent: Consent, read: ReadText
) -> Setting:
    _check_exists(file, folder)
    try:
        theory = theory_of_file(folder / file, consent, read)
        games = theory.games
    except UnreadableError as error:
        raise StoryError(error.message) from error
    except TTRError as error:
        place = f"{error.span.source}:{error.span.line}: " if error.span else ""
        raise StoryError(f"{file} cannot be read: {place}{error.message}") from error
    if not name and len(games) == 1:
        (name,) = games
    if name not in games:
        raise StoryError(_no_game_message(file, name, tuple(games)))
    return Setting(games[name], theory)


def _of_python(path: str, name: str, folder: Path, consent: Consent | None) -> Setting:
    module = _module(path, folder, consent)
    games = {key: one for key, one in vars(module).items() if isinstance(one, Game)}
    if name not in games:
        raise StoryError(_no_game_message(path, name, tuple(games)))
    game = games[name]
    theory = game.theory or _with_definitions(module, _mentioned_theory(game))
    return Setting(game, theory)


def _check_exists(file: str, folder: Path) -> None:
    path = folder / file
    if os.path.isfile(path):
        return
    beside = [one.name for one in path.parent.glob(f"*{path.suffix}")]
    near = suggestion(path.name, beside)
    raise StoryError(f"there is no file {file}" + f": {near}" * bool(near))


def _no_game_message(file: str, name: str, known: tuple[str, ...]) -> str:
    told = f"{file} has no game {name}" if name else f"name a game of {file}"
    if not known:
        return f"{told}: there is none in it"
    return f"{told}: {suggestion(name, known) or 'it has ' + ', '.join(known)}"


# --- games in Python -----------------------------------------------------------------


def _module(path: str, folder: Path, consent: Consent | None) -> ModuleType:
    """The module of a file or of a dotted name."""
    if path.endswith(".py"):
        _check_exists(path, folder)
    try:
        return run_named(path, folder, "_played_", consent)
    except NotAllowedError:
        raise
    except Exception as error:
        raise StoryError(_failure_message(path, error)) from error


def _failure_message(path: str, error: Exception) -> str:
    if isinstance(error, ModuleNotFoundError) and error.name in _with_parents(path):
        return f"there is no module {path}: name a game as {_WRITTEN}"
    fault = f"{type(error).__name__}: {error}".splitlines()[0]
    return f"{path} cannot be run: {fault}"


def _with_parents(module: str) -> list[str]:
    """A dotted name and the packages around it: a, a.b and a.b.c."""
    return [".".join(module.split(".")[: n + 1]) for n in range(module.count(".") + 1)]


def _mentioned_theory(game: Game) -> Theory:
    """The theory that declares all that occurs in a game."""
    types = [T for rule in game.rules for T in (rule.when, rule.on, rule.gives)]
    planned = [T for T in types if T is not None]
    return Theory.of(game.type, game.start, *game.hears, *planned)


def _with_definitions(module: ModuleType, theory: Theory) -> Theory:
    """The theory with the names that a Python module gives to types."""
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
