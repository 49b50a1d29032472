"""Speakers, who have their own meanings of words and correct one another."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from ttr.errors import TTRError, suggestion
from ttr.probability import Degree
from ttr.semantics.argument_checks import as_tuple, in_notation
from ttr.semantics.perceptual.learners import Handle
from ttr.semantics.perceptual.meanings import Meaning, as_meaning
from ttr.showing import NotebookValue, Part, Table, Text, below, name_list
from ttr.types.objects import Record

_FEW = 6
"""A notebook shows the meanings of so many words; of the others, their names."""


def says(meaning: Meaning, r: Record) -> bool:
    """Would somebody with this meaning say the word? Its degree is at least a half.

    >>> from ttr import Ind, Pred, record, rectype, this
    >>> from ttr.semantics.perceptual import GradedPerceptron, RealVector
    >>> from ttr.semantics.perceptual import interpretation, meaning
    >>> T = rectype(x=Ind, pos=RealVector, c=Pred("right", Ind)(this.x))
    >>> weights = record(w=[1, 0], t=0.5)
    >>> right = meaning(interpretation(T, "c"), GradedPerceptron(), weights, of="pos")
    >>> [says(right, record(x="o1", pos=[x, 0.0])) for x in (0.2, 0.7)]
    [False, True]
    """
    return meaning.degree(r).lo >= 0.5


@dataclass(frozen=True)
class Speaker(NotebookValue):
    """An agent with meanings of words. Learning gives a speaker with other meanings.

    Meanings of a speaker that share a learner go on sharing it: what it learns for one
    of them, it has learned for all.

    >>> from ttr import Ind, Pred, record, rectype, this
    >>> from ttr.semantics.perceptual import Perceptron, RealVector, blank
    >>> from ttr.semantics.perceptual import interpretation, meaning
    >>> T = rectype(x=Ind, pos=RealVector, c=Pred("right", Ind)(this.x))
    >>> right = meaning(interpretation(T, "c"), Perceptron(), blank(2), of="pos")
    >>> bo, s = Speaker("bo", {"right": right}), record(x="o1", pos=[0.9, 0.1])
    >>> print(bo.degrees(s)["right"], bo.confirmed("right", s).degrees(s)["right"])
    0 1
    """

    name: str
    meanings: Mapping[str, Meaning]

    def __post_init__(self) -> None:
        if not isinstance(self.meanings, Mapping):
            raise TTRError(
                "a speaker has a mapping from words to meanings, "
                f"found {type(self.meanings).__name__}"
            )
        own = {_word(word): as_meaning(it) for word, it in self.meanings.items()}
        object.__setattr__(self, "meanings", MappingProxyType(own))

    def __hash__(self) -> int:
        return hash((self.name, frozenset(self.meanings)))

    def __reduce__(self) -> tuple[object, ...]:
        return Speaker, (self.name, dict(self.meanings))

    def __str__(self) -> str:
        return f"{self.name}, who knows {', '.join(sorted(self.meanings))}"

    def _shown_as_(self) -> Part:
        known = sorted(self.meanings.items())
        rows = [(Text(word, "strong"), it._shown_as_()) for word, it in known[:_FEW]]
        rest = [word for word, _ in known[_FEW:]]
        return below(
            Text(self.name, "strong"),
            Table(("word", "meaning"), tuple(rows)),
            name_list(rest) if rest else None,
        )

    def __getitem__(self, word: str) -> Meaning:
        if isinstance(word, str) and word in self.meanings:
            return self.meanings[word]
        written = repr(word) if isinstance(word, str) else in_notation(word)
        raise TTRError(
            f"{self.name} has no meaning of {written}",
            hint=suggestion(str(word), self.meanings),
        )

    def degrees(self, r: Record) -> dict[str, Degree]:
        """The degrees of the words with a percept in the situation, highest first."""
        found = {
            word: it.degree(r)
            for word, it in self.meanings.items()
            if it.clf.has_percept(r)
        }
        order = sorted(found, key=lambda word: (-found[word].lo, -found[word].hi, word))
        return {word: found[word] for word in order}

    def with_meaning(self, word: str, meaning: Meaning) -> Speaker:
        """The speaker with this meaning of the word."""
        return Speaker(self.name, {**self.meanings, _word(word): meaning})

    def confirmed(self, word: str, r: Record) -> Speaker:
        """The speaker after somebody agreed that the word holds."""
        return self._with_learned_meaning(word, self[word].confirmed(r))

    def rejected(self, word: str, r: Record) -> Speaker:
        """The speaker after somebody denied that the word holds."""
        return self._with_learned_meaning(word, self[word].rejected(r))

    def corrected(self, r: Record, *, said: str, right: str) -> Speaker:
        """The speaker after "No, this is a …": one word rejected, the other confirmed.

        Two words that share a learner get one lesson, of the right word: as degrees sum
        to at most 1, the other word loses what this gains. Raises what
        `Meaning.rejected` and `Meaning.confirmed` raise; then nothing is learned.
        """
        wrong, wanted = self[said], self[right]
        if said == right:
            raise TTRError(f"{said!r} cannot be what is corrected and what is right")
        shared = _learner(wrong)
        if shared is not None and shared is _learner(wanted):
            return self.confirmed(right, r)
        return self.rejected(said, r).confirmed(right, r)

    def _with_learned_meaning(self, word: str, learned: Meaning) -> Speaker:
        """The speaker with a learned meaning, also for words that share its learner."""
        old = _learner(self[word])
        changed = {
            other: it.with_params(learned.params)
            for other, it in self.meanings.items()
            if old is not None and _learner(it) is old
        }
        return Speaker(self.name, {**self.meanings, **changed, word: learned})


def as_speaker(value: object) -> Speaker:
    """The speaker itself; `TTRError` for what is none."""
    if isinstance(value, Speaker):
        return value
    raise TTRError(f"expected a speaker, found {in_notation(value)}")


def _word(value: object) -> str:
    if isinstance(value, str):
        return value
    raise TTRError(f"a word is a text, found {in_notation(value)}")


def exchange(teacher: Speaker, pupil: Speaker, word: str, r: Record) -> Speaker:
    """The pupil after both have said whether a word holds in a situation.

    Where they disagree, the pupil is corrected; else nothing changes. Source: the game
    of Larsson 2013.

    >>> from ttr import Ind, Pred, record, rectype, this
    >>> from ttr.semantics.perceptual import Perceptron, RealVector, blank
    >>> from ttr.semantics.perceptual import interpretation, meaning
    >>> T = rectype(x=Ind, pos=RealVector, c=Pred("right", Ind)(this.x))
    >>> right = meaning(interpretation(T, "c"), Perceptron(), blank(2), of="pos")
    >>> ann = Speaker("ann", {"right": right.with_params(record(w=[1, 0], t=0.5))})
    >>> bo, s = Speaker("bo", {"right": right}), record(x="o1", pos=[0.9, 0.1])
    >>> print(exchange(ann, bo, "right", s).degrees(s)["right"])
    1
    """
    teacher, pupil = as_speaker(teacher), as_speaker(pupil)
    wanted = says(teacher[word], r)
    if says(pupil[word], r) == wanted:
        return pupil
    return pupil.confirmed(word, r) if wanted else pupil.rejected(word, r)


def history(
    teacher: Speaker, pupil: Speaker, word: str, situations: Iterable[Record]
) -> tuple[Speaker, ...]:
    """The pupil before any exchange, and after that about each of the situations.

    >>> from ttr import Ind, Pred, record, rectype, this
    >>> from ttr.semantics.perceptual import Perceptron, RealVector, blank
    >>> from ttr.semantics.perceptual import interpretation, meaning
    >>> T = rectype(x=Ind, pos=RealVector, c=Pred("right", Ind)(this.x))
    >>> right = meaning(interpretation(T, "c"), Perceptron(), blank(2), of="pos")
    >>> ann = Speaker("ann", {"right": right.with_params(record(w=[1, 0], t=0.5))})
    >>> scenes = [record(x="o1", pos=[x, 0.0]) for x in (0.9, 0.2)]
    >>> pupils = history(ann, Speaker("bo", {"right": right}), "right", scenes)
    >>> [says(pupil.meanings["right"], scenes[0]) for pupil in pupils]
    [False, True, True]
    """
    pupils = [as_speaker(pupil)]
    for r in as_tuple(situations, "situations"):
        pupils.append(exchange(teacher, pupils[-1], word, r))
    return tuple(pupils)


def _learner(meaning: Meaning) -> Handle | None:
    found = meaning.params._fields.get("learner")
    return found if isinstance(found, Handle) else None
