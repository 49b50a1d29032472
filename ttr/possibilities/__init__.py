"""Modal type systems: possibilities that share their types and differ in witnesses."""

from ttr.possibilities.modality import (
    ModalAnswer,
    nec,
    necessarily,
    poss,
    possibly,
)
from ttr.possibilities.notions import Notion
from ttr.possibilities.systems import ModalSystem, modal_system

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
