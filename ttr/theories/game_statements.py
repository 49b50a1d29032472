"""Reads games: `game g({x = a} : S, acts on next, hears A, B) := strategy`."""

from __future__ import annotations

from ttr.building.well_formedness import field_at_path
from ttr.errors import IllFormedError
from ttr.notation.reader import Reader
from ttr.notation.syntax_trees import GameStatement, Name, Term
from ttr.signature.signature import Opening
from ttr.theories.rule_statements import read_state_type
from ttr.theories.strategy_statements import read_strategy
from ttr.types.objects import Path, Record
from ttr.types.syntax import ListOf, NonEmpty, RecordType, Singleton, TypeNode


def read_game(tree: GameStatement, reader: Reader) -> Opening:
    """The game that a statement declares; raises `NotationError` or
    `IllFormedError`.
    """
    state = read_state_type(tree.type, reader)
    start = reader.object(tree.begin, ())
    if not isinstance(start, Record):
        reader.refuse(
            tree.begin,
            f"a game starts from a state, a record, found {reader.text_of(tree.begin)}",
            "write {x = a, …}",
        )
    played = read_strategy(tree.value, reader)
    agenda = _agenda(tree.agenda, state, reader) if tree.agenda else None
    span = reader.source.span(tree.begin)
    hears = tuple(reader.type(T, ()) for T in tree.hears)
    heard_at = tuple(map(reader.source.span, tree.hears))
    return Opening(tree.name.text, state, start, played, agenda, span, hears, heard_at)


def _agenda(term: Term, state: RecordType, reader: Reader) -> str:
    """The path in the state at which there is the list of types to act on."""
    match term:
        case Name(_, _, labels, None):
            path = Path(0, labels)
        case _:
            found = reader.text_of(term)
            reader.refuse(
                term,
                f"a game acts on the path of a list of types, found {found}",
                "write acts on agenda, or acts on shared.next",
            )
    try:
        found_type = field_at_path(path, state)
    except IllFormedError as error:
        raise error.at(reader.source.span(term)) from None
    if not _may_be_list(found_type):
        reader.refuse(
            term,
            f"a game acts on a list of types, but {reader.text_of(term)} is of "
            f"{found_type}",
        )
    return ".".join(labels)


def _may_be_list(T: TypeNode) -> bool:
    match T:
        case Singleton(base, _):
            return _may_be_list(base)
        case ListOf() | NonEmpty():
            return True
    return False
