"""A phrase book: a table from phrases to moves, and one from moves to wordings.

It is a toy language, but it is data: both tables have terms of the notation. What
stands between the phrases of a text is ignored.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Self

from ttr.errors import TTRError
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model
from ttr.semantics.gameboards.ibis.moves import (
    USR,
    Move,
    content_of,
    unclear,
    with_terms,
)
from ttr.semantics.gameboards.ibis.state import utterance
from ttr.semantics.questions import asked_of
from ttr.theories.theory import Theory
from ttr.types.objects import Object, Record
from ttr.types.printing import notation
from ttr.types.syntax import PType, TypeNode

_SORT = re.compile(r"\{(\w+)\}")
_MOVES = re.compile(r"\s*(\w+\(.*\)|\[.*\])\s*", re.DOTALL)


@dataclass(frozen=True, eq=False)
class PhraseBook:
    """Reads texts as utterances of the user, and words utterances of the system.

    `phrases` maps words to moves. `wordings` maps moves, their contents and their
    predicates to texts; it is tried in this order. `answers` maps questions to texts
    for positive answers to them, with what is asked for in braces.

    >>> from ttr import Model, Theory
    >>> from ttr.semantics.gameboards.ibis.moves import USR, greet
    >>> texts = {"phrases": {"hello": "greet(usr)"}, "wordings": {}, "answers": {}}
    >>> book = PhraseBook.of(Theory.of(greet(USR)), with_terms(Model()), **texts)
    >>> print(book.hear("Hello!"))
    {moves = [greet(usr)], spkr = usr}
    """

    theory: Theory
    model: Model
    phrases: Mapping[tuple[str, ...], Object]
    wordings: Mapping[Object, str]
    answers: Mapping[Object, str]

    @classmethod
    def of(
        cls,
        theory: Theory,
        model: Model,
        *,
        phrases: Mapping[str, str],
        wordings: Mapping[str, str],
        answers: Mapping[str, str],
    ) -> Self:
        """The phrase book of tables of texts, whose meanings are in the notation.

        A sort in braces in a phrase, as in "to {City}", stands for each object of that
        sort. Raises `TTRError` for a phrase that stands for no move.
        """
        meant = {
            tuple(_words(said)): _move(move, theory, model)
            for pattern, term in phrases.items()
            for said, move in _instances(pattern, term, theory, model)
        }
        texts = {_term(term, theory): text for term, text in wordings.items()}
        answered = {_term(term, theory): text for term, text in answers.items()}
        return cls(theory, with_terms(model), meant, texts, answered)

    # --- reading ---

    def hear(self, text: str) -> Record:
        """The utterance that a text is; its moves may also be written in the notation.

        A text without known phrases is the move `unclear`; an empty text is no move.
        """
        if _MOVES.fullmatch(text):
            moves = self._moves_in_notation(text)
        else:
            moves = tuple(self._moves_of_phrases(_words(text)))
        return utterance(USR, moves or (unclear(USR),) * bool(text.strip()))

    def _moves_in_notation(self, text: str) -> tuple[Object, ...]:
        """The moves of a text in the notation; none where it is no such text."""
        try:
            found = self.theory.parse(text)
        except TTRError:
            return ()
        moves = found if isinstance(found, tuple) else (found,)
        right = all(self.model.judge(move, Move).holds for move in moves)
        return moves if right else ()

    def _moves_of_phrases(self, words: Sequence[str]) -> Iterator[Object]:
        """The moves of the phrases in a text, left to right, longest phrases first."""
        longest = max(map(len, self.phrases), default=0)
        start = 0
        while start < len(words):
            sizes = range(min(longest, len(words) - start), 0, -1)
            tried = (tuple(words[start : start + size]) for size in sizes)
            phrase = next((one for one in tried if one in self.phrases), None)
            if phrase is None:
                start += 1
                continue
            yield self.phrases[phrase]
            start += len(phrase)

    # --- wording ---

    def say(self, said: Judgement) -> str:
        """The words for an utterance of the system."""
        return " ".join(map(self.word_move, said.sit.moves))

    def word_move(self, move: PType) -> str:
        """The words for a move: its own, or those of its content or predicate."""
        content = content_of(move)
        own = self.wordings.get(move) or self.wordings.get(content)
        if own is not None:
            return own
        for question, wording in self.answers.items():
            found = isinstance(content, TypeNode) and asked_of(
                question, content, self.model
            )
            if isinstance(found, Record):
                return wording.format_map(found._fields)
        return self.wordings.get(move.pred) or f"{notation(move)}."


def _words(text: str) -> list[str]:
    return re.findall(r"[\w-]+", text.lower())


def _term(text: str, theory: Theory) -> Object:
    """The term or, by its name, the predicate that a text stands for."""
    return theory[text] if text in theory.names else theory.parse(text)


def _move(text: str, theory: Theory, model: Model) -> Object:
    move = theory.parse(text)
    if model.judge(move, Move).holds:
        return move
    raise TTRError(f"a phrase stands for a move, but {text} is none")


def _instances(
    words: str, term: str, theory: Theory, model: Model
) -> Iterator[tuple[str, str]]:
    """A phrase and its term, for each object of the sort in braces if there is one."""
    slot = _SORT.search(words)
    if slot is None:
        yield words, term
        return
    sort = theory.parse(slot[1])
    for one in model.witnesses(sort):
        yield words.replace(slot[0], one), term.replace(slot[0], one)
