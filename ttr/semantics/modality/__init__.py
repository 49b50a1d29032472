"""Modal type systems: possibilities that share their types and differ in witnesses.

A possibility is a model. Whether a proposition is necessary or possible is asked of the
whole system, by one of two notions. Source: Cooper 2023.

Read `modal_systems` first, then `notions`, then `necessity` (box and diamond types, and
answers). May import: argument_checks, judging and all below.
"""

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
