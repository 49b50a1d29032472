"""What words, phrases and moves mean in a theory: the types of its dialogues."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from kille.dialogue.meanings import DialogueTypes, packaged_types
from kille.dialogue.theory_files import theory_of_file, theory_with
from kille.lab.errors import TheoryError
from kille.lab.study import Theory


def meanings_of(theory: Theory) -> DialogueTypes:
    """The types of a theory: the packaged ones, some of them redefined, or a file's.

    `TheoryError` where there is no such file, and `TTRError` for what is no theory.

    >>> given = Theory("deictic", meanings={"It": "[look : Look, x : Ind]"})
    >>> print(meanings_of(given)["It"])
    [look : Look, x : Ind]
    """
    own = theory.meanings
    if not own:
        return packaged_types()
    if not isinstance(own, str):
        return _redefine(tuple(own.items()))
    folders = theory.consent.folders if theory.consent is not None else ()
    try:
        changed = Path(own).stat().st_mtime_ns
    except OSError as error:
        raise TheoryError(f"there is no file {own}") from error
    return _read_types(own, tuple(folders), changed)


@lru_cache
def _redefine(types: tuple[tuple[str, str], ...]) -> DialogueTypes:
    return DialogueTypes(theory_with(dict(types)))


@lru_cache
def _read_types(file: str, folders: tuple[Path, ...], _: int) -> DialogueTypes:
    """The types of a file as it was when it was changed last."""
    return DialogueTypes(theory_of_file(file, folders))
