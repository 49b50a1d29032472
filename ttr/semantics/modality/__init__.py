"""Modal type systems: possibilities that share their types and differ in witnesses."""

from ttr.semantics.modality.modal_systems import ModalSystem, modal_system
from ttr.semantics.modality.necessity import (
    ModalAnswer,
    nec,
    necessarily,
    poss,
    possibly,
)
from ttr.semantics.modality.notions import Notion

__all__ = [
    "ModalAnswer",
    "ModalSystem",
    "Notion",
    "modal_system",
    "nec",
    "necessarily",
    "poss",
    "possibly",
]
