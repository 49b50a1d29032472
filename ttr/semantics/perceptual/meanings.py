r"""Meanings with classifiers inside: {params, bg, clf, interp}, ordinary records.

A situation of the background type `bg` has a percept in it. By the parameters `params`,
the classifier `clf` gives the degree to which the word holds of the percept, and
`interp` gives the situation its type. To learn is to get a meaning with other
parameters; the old meaning does not change. Source: Larsson 2013.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, cast

from ttr.building.function_domains import fix
from ttr.errors import TTRError, UndecidedError, UnsupportedError, describe_error
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model, as_model
from ttr.probability import UNKNOWN, Degree, degree
from ttr.semantics.perceptual.classifiers import Classifier, Method
from ttr.semantics.perceptual.interpretations import claim_of
from ttr.semantics.perceptual.meaning_form import check_record
from ttr.semantics.perceptual.pictures import picture_of
from ttr.semantics.perceptual.vectors import RealVector, is_vector
from ttr.showing import NotebookValue, Part, Value, beside
from ttr.types.interning import identity
from ttr.types.objects import BOUND, Object, Path, Record, UnresolvedError, record
from ttr.types.paths import subterms
from ttr.types.printing import notation
from ttr.types.substitution import resolve_paths
from ttr.types.syntax import Function, Negation, Pred, PType, RecordType, TypeNode


def meaning(
    interp: Function,
    method: Method,
    params: Record | Mapping[str, object],
    *,
    of: str | tuple[str, ...],
    through: Callable[..., object] | None = None,
) -> Meaning:
    r"""The meaning {params, bg, clf, interp} of a word; bg is the domain of interp.

    `of` is the path of the percept in a situation, or several paths. Where handles are
    found there, `through` makes the percept of them.

    >>> from ttr import Ind, fun, outer, rectype
    >>> from ttr.semantics.perceptual.perceptron import Perceptron
    >>> bg = rectype(foo=Ind, spkr=Ind, pos=RealVector)
    >>> to_the_right = rectype(c=Pred("right", Ind)(outer.r.foo))
    >>> params = record(w=[0.8, 0.01], t=0.09)
    >>> right = meaning(fun(r=bg)(to_the_right), Perceptron(), params, of="pos")
    >>> s = record(foo="o1", spkr="a", pos=[0.9, 0.1])
    >>> round(right.score(s), 3), str(right.classify(s))
    (0.721, 'right(o1)')
    >>> print(right.rejected(s).params)
    {t = 1.09, w = [-0.09999999999999998, -0.09000000000000001]}
    """
    clf = Classifier(method, (of,) if isinstance(of, str) else of, through)
    bg = interp.domain if isinstance(interp, Function) else interp
    return Meaning(record(params=params, bg=bg, clf=clf, interp=interp))


@dataclass(frozen=True)
class Meaning(NotebookValue):
    """A perceptual meaning: a view of the record {params, bg, clf, interp}.

    Meanings are equal when their records are. Raises `TTRError` for any other record.

    >>> from ttr import Ind, Pred, record, rectype, this
    >>> from ttr.semantics.perceptual import Perceptron, RealVector, blank
    >>> from ttr.semantics.perceptual import interpretation, meaning
    >>> T = rectype(x=Ind, pos=RealVector, c=Pred("right", Ind)(this.x))
    >>> right = meaning(interpretation(T, "c"), Perceptron(), blank(2), of="pos")
    >>> s = record(x="o1", pos=[0.9, 0.1])
    >>> print(right.classify(s), right.confirmed(s).classify(s))
    ~right(o1) right(o1)
    """

    record: Record

    def __post_init__(self) -> None:
        check_record(self.record)

    def __str__(self) -> str:
        return str(self.record)

    def _shown_as_(self) -> Part:
        one = len(self.clf.of) == 1 or "learner" in self.params._fields
        picture = picture_of(self.params, self._degree_of) if one else None
        return beside(Value(self.record), picture)

    # --- what it is made of ---

    @property
    def params(self) -> Record:
        """The parameters: what learning changes."""
        return cast(Record, self.record._fields["params"])

    @property
    def bg(self) -> RecordType:
        """The background: the type of the situations that the word can be said of."""
        return cast(RecordType, self.record._fields["bg"])

    @property
    def clf(self) -> Classifier:
        """The classifier: its method, and where its percept is."""
        return cast(Classifier, self.record._fields["clf"])

    @property
    def interp(self) -> Function:
        """The interpretation: a function from situations to types."""
        return cast(Function, self.record._fields["interp"])

    @cached_property
    def claim(self) -> PType:
        """The ptype in the interpretation, with paths into the situation."""
        return claim_of(self.interp)[1]

    @property
    def predicate(self) -> Pred:
        """The word's own predicate."""
        return self.claim.pred

    @property
    def type(self) -> RecordType:
        """The type of situations in which the word holds: the fixed point of interp.

        Merge such types for the situations in which several words hold.
        """
        return fix(self.interp)

    # --- what it says of a situation ---

    def degree(self, r: Record, /) -> Degree:
        """The degree to which the word holds of what is perceived in a situation.

        [0, 1] where nothing can be seen. Raises `TTRError` where there is no percept,
        and where the classifier fails or its answer is no degree.
        """
        return self._degree_of(self._percept(r))

    def score(self, r: Record, /) -> float:
        """The score that the method compares with its threshold, if it has one."""
        method = self.clf.method
        if not hasattr(method, "score"):
            raise UnsupportedError(f"{self._word}: {method} has degrees, but no score")
        x = self._percept(r)
        if x is None:
            raise UndecidedError(f"{self._word}: nothing can be seen in {notation(r)}")
        return float(self._ask(method.score, x))

    def classify(self, r: Record, /) -> TypeNode:
        """The claim that the word holds of the situation, or the negation of it.

        It holds if its degree is at least a half. Raises `UndecidedError` where the
        interval leaves that open.
        """
        p = self.degree(r)
        if p.lo < 0.5 <= p.hi:
            raise UndecidedError(
                f"{self._word}: {notation(r)} may be so or not, with the degree {p}"
            )
        claim: PType = self._ground(self.claim, ({}, {BOUND: r}))
        return claim if p.lo >= 0.5 else Negation(claim)

    def content(self, r: Record, /) -> TypeNode:
        """interp(r): what the word means when it is said in the situation."""
        content: TypeNode = self._ground(self.interp.body, ({BOUND: r},))
        return content

    # --- what it learns from feedback ---

    def confirmed(self, r: Record, /) -> Meaning:
        """The meaning after the word was rightly said in the situation.

        The method changes the parameters; if it changes none, this is the same meaning.
        Raises `TTRError` where nothing can be seen, and where the method fails.
        """
        return self._learn(self.clf.method.confirmed, r)

    def rejected(self, r: Record, /) -> Meaning:
        """The meaning after the word was wrongly said in the situation.

        As `confirmed`; raises `UnsupportedError` where the method cannot learn from it.
        """
        return self._learn(self.clf.method.rejected, r)

    def with_params(self, params: Record | Mapping[str, object], /) -> Meaning:
        """The meaning with these parameters instead."""
        return Meaning(record({**self.record._fields, "params": params}))

    # --- in a model ---

    def witness(self, *situations: Record) -> Callable[..., Degree]:
        """The witness function of the word's predicate.

        The percept is taken from the arguments of the predicate where all of it is
        among them; else from the last of these situations with the same arguments. The
        degree is [0, 1] where there is none.
        """
        seen = {self._key(r): self._percept(r) for r in situations}
        paths = [_path(arg) for arg in self.claim.args]
        needed = [tuple(path.split(".")) for path in self.clf.of]
        places = [paths.index(path) for path in needed if path in paths]

        def degree_of(*args: Object) -> Degree:
            if len(places) == len(needed):
                return self._degree_of(self._percept_of(*[args[i] for i in places]))
            return self._degree_of(seen.get(identity(args)))

        return degree_of

    def in_model(self, M: Model, /, *situations: Record) -> Model:
        """The model in which the classifier judges what the predicate holds of."""
        M = as_model(M)
        if any(part is RealVector for part in subterms([self.bg])):
            M = M.witnessed(RealVector, by=is_vector)
        return M.witnessed(self.predicate, by=self.witness(*situations))

    def judge(self, M: Model, r: Record, /) -> Judgement:
        """Judge whether the situation, with what is perceived in it, is of `type`."""
        return self.in_model(M, r).perceive(r, self.type)

    # --- asking the classifier ---

    @property
    def _word(self) -> str:
        return self.predicate.name

    def _percept(self, r: Record) -> Object | None:
        if not isinstance(r, Record):
            raise TTRError(f"{self._word} is said of a record, found {notation(r)}")
        try:
            return self.clf.percept(r)
        except TTRError as error:
            raise self._with_word(error) from None

    def _percept_of(self, *found: Object) -> Object | None:
        try:
            return self.clf.percept_of(*found)
        except TTRError as error:
            raise self._with_word(error) from None

    def _degree_of(self, x: Object | None) -> Degree:
        if x is None:
            return UNKNOWN
        found = self._ask(self.clf.method.degree, x)
        try:
            return degree(found, f"{self._word}: a degree")
        except TTRError as error:
            raise self._with_word(error) from None

    def _learn(self, step: Callable[[Record, Object], Record], r: Record) -> Meaning:
        x = self._percept(r)
        if x is None:
            raise TTRError(
                f"{self._word}: nothing can be seen in {notation(r)} to learn from"
            )
        params = self._ask(step, x)
        return self if params is self.params else self.with_params(params)

    def _ask(self, ask: Callable[[Record, Object], Any], x: Object) -> Any:
        """The answer of the method; its errors are reported with the word."""
        try:
            return ask(self.params, x)
        except TTRError as error:
            raise self._with_word(error) from None
        except Exception as error:
            raise TTRError(
                f"{self._word}: {self.clf.method} failed on {notation(x)}: "
                f"{describe_error(error)}"
            ) from error

    def _with_word(self, error: TTRError) -> TTRError:
        """The error with the word in front of its message."""
        if error.message.startswith(f"{self._word}: "):
            return error
        message = f"{self._word}: {error.message}"
        return error.__class__(message, hint=error.hint)

    def _ground(self, value: Object, around: tuple[Mapping[str, Object], ...]) -> Any:
        try:
            return resolve_paths(value, around)
        except UnresolvedError as error:
            raise self._with_word(TTRError(error.message)) from None

    def _key(self, r: Record) -> object:
        """The identity of the predicate's arguments in a situation."""
        args = self._ground(self.claim.args, ({}, {BOUND: r}))
        return identity(args)


def as_meaning(value: object) -> Meaning:
    """A meaning itself, a record as a meaning; `TTRError` for what is neither."""
    return value if isinstance(value, Meaning) else Meaning(cast(Record, value))


def _path(arg: Object) -> tuple[str, ...] | None:
    """The path into the situation that an argument is, or None."""
    return arg.labels[1:] if isinstance(arg, Path) else None
