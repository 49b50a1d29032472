"""Check that a record is a perceptual meaning {params, bg, clf, interp}."""

from __future__ import annotations

from ttr.errors import TTRError
from ttr.semantics.argument_checks import in_notation
from ttr.semantics.perceptual.classifiers import Classifier
from ttr.semantics.perceptual.interpretations import claim_of
from ttr.types.objects import Record
from ttr.types.printing import notation
from ttr.types.syntax import Basic, Function, PType, RecordType

_FIELDS: dict[str, tuple[type, str]] = {
    "params": (Record, "a record"),
    "bg": (RecordType, "a record type"),
    "clf": (Classifier, "a Classifier"),
    "interp": (Function, "a function"),
}


def check_record(found: object) -> None:
    """Raise `TTRError` for what is no record {params, bg, clf, interp}.

    The domain of interp has to be bg, and the percept of clf has to be in bg.
    """
    if not isinstance(found, Record) or set(found) != set(_FIELDS):
        raise TTRError(
            f"a perceptual meaning is a record {{params, bg, clf, interp}}, "
            f"found {in_notation(found)}"
        )
    for label, (kind, name) in _FIELDS.items():
        if not isinstance(found[label], kind):
            raise TTRError(
                f"the {label} of a meaning is {name}, found {notation(found[label])}"
            )
    if found.interp.domain is not found.bg:
        raise TTRError(
            f"the interp of a meaning takes situations of its bg {found.bg}, "
            f"found {found.interp}"
        )
    claim_of(found.interp)
    for path in found.clf.of:
        _check_path(found.bg, path)


def _check_path(bg: RecordType, path: str) -> None:
    """Raise `TTRError` for a path that situations of the background do not have."""
    T: object = bg
    for label in path.split("."):
        if isinstance(T, Basic | PType) or (
            isinstance(T, RecordType) and label not in T
        ):
            raise TTRError(
                f"the percept is to be found at {path}, which the bg {bg} lacks"
            )
        if not isinstance(T, RecordType):
            return
        T = T[label]
