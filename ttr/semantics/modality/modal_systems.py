"""Modal type systems: named possibilities over one theory, each a model.

Models are immutable, so what is judged in one possibility never affects another.
Whether something is necessary or possible is asked of the whole system, by the
restrictive or the inclusive notion (`notions`).
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace

from ttr.errors import IllFormedError, RefusedError, suggestion
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model
from ttr.safety.budgets import within_budget
from ttr.semantics.argument_checks import in_notation
from ttr.semantics.modality.necessity import modal_claims, nec
from ttr.semantics.modality.notions import Notion, everywhere, where_they_exist
from ttr.types.objects import Object, combine_labels, freeze
from ttr.types.paths import subterms
from ttr.types.syntax import Basic, Pred, PType, TypeNode, as_type, kind_of

_Head = Basic | Pred
"""What a possibility may lack: a basic type, or a predicate and so its ptypes."""


@dataclass(frozen=True, eq=False, repr=False)
class ModalSystem:
    """Named possibilities over one theory. Built by `modal_system`.

    >>> dog = Pred("dog", Basic("Ind"))
    >>> w = modal_system(here=Model().given("s1", dog("fido")), there=Model())
    >>> print(w.restrictive.necessary(dog("fido")))
    no: nothing is of dog(fido) in there
    >>> print(w.restrictive.possible(dog("fido")))
    yes: something is of dog(fido) in here
    >>> w = w.given("there", "s2", dog("fido"))
    >>> w.restrictive.necessary(dog("fido")).yes
    True
    """

    models: tuple[tuple[str, Model], ...]
    lacking: Mapping[str, frozenset[_Head]]

    def __repr__(self) -> str:
        return f"<ModalSystem of {', '.join(self.names)}>"

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the possibilities, in the order in which they were given."""
        return tuple(name for name, _ in self.models)

    def __getitem__(self, name: str) -> Model:
        """The model of a possibility; raises `IllFormedError` for an unknown name.

        >>> modal_system(w1=Model())["w2"]
        Traceback (most recent call last):
        ttr.errors.IllFormedError: there is no possibility w2, only w1
        """
        for known, model in self.models if isinstance(name, str) else ():
            if known == name:
                return model
        written = in_notation(name)
        raise IllFormedError(
            f"there is no possibility {written}, only {', '.join(self.names)}",
            hint=suggestion(written, self.names),
        )

    def given(
        self, name: str, sit: object, T: TypeNode, /, p: object = 1.0
    ) -> ModalSystem:
        """The system in which also sit : T, in this possibility and in no other.

        Raises what `Model.given` raises, and `IllFormedError` where T does not exist
        there.
        """
        self._check_exists(name, T)
        changed = self[name].given(sit, T, p)
        models = [(known, model) for known, model in self.models]
        models[self.names.index(name)] = (name, changed)
        return replace(self, models=tuple(models))

    def without(self, name: str, /, *heads: _Head) -> ModalSystem:
        """The system in which a possibility lacks basic types or predicates.

        A type exists in a possibility that lacks nothing of what occurs in it.

        >>> Unicorn = Basic("Unicorn")
        >>> w = modal_system(w1=Model(), w2=Model().given("u", Unicorn))
        >>> print(w.without("w1", Unicorn).inclusive.necessary(Unicorn))
        yes: something is of Unicorn in w2
        >>> print(w.without("w1", Unicorn).restrictive.necessary(Unicorn))
        no: Unicorn does not exist in w1
        """
        self[name]
        for head in heads:
            if not isinstance(head, Basic | Pred):
                raise IllFormedError(
                    "what a possibility lacks is a basic type or a predicate, "
                    f"found {kind_of(head)}"
                )
        lacked = self.lacking.get(name, frozenset()).union(heads)
        return replace(self, lacking={**self.lacking, name: lacked})

    def has(self, name: str, value: Object, /) -> bool:
        """Do the types that occur in a type or proposition exist in a possibility?"""
        self[name]
        lacked = self.lacking.get(name)
        if not lacked:
            return True
        return lacked.isdisjoint(
            one for one in subterms([value]) if isinstance(one, Basic | Pred)
        )

    @within_budget
    def judge(self, name: str, sit: object, T: TypeNode, /) -> Judgement:
        """Is sit of T in this possibility? Box and diamond types ask the whole system.

        Any situation of the possibility is of nec(T) to the degree to which T is
        necessary by the restrictive notion.

        >>> from ttr.semantics.modality import necessarily, possibly
        >>> Rain = Basic("Rain")
        >>> w = modal_system(w1=Model().given("r", Rain), w2=Model())
        >>> w.judge("w1", "s", possibly(Rain) & ~necessarily(Rain)).holds
        True
        """
        self._check_exists(name, T)
        model, asked = self[name], freeze(sit)
        for part, kind in modal_claims(asked, T):
            with suppress(RefusedError):
                model = self._with_modal_judgement(model, part, kind)
        return model.judge(asked, T)

    def _with_modal_judgement(self, model: Model, sit: Object, box: PType) -> Model:
        """The model with a judgement of a box or diamond type.

        Its argument is reduced first; raises `RefusedError` where that cannot be done.
        """
        kind = PType(box.pred, (model.reduce(box.args[0]),))
        notion = self.restrictive
        asks = notion.necessary if kind.pred is nec else notion.possible
        return model.given(sit, kind, asks(kind.args[0]).p)

    @property
    def restrictive(self) -> Notion:
        """The notion that looks at types which exist in every possibility."""
        return Notion(self, everywhere)

    @property
    def inclusive(self) -> Notion:
        """The notion that looks at the possibilities in which the types exist."""
        return Notion(self, where_they_exist)

    def _check_exists(self, name: str, T: TypeNode) -> None:
        self[name]
        if not self.has(name, as_type(T)):
            raise IllFormedError(f"{T} does not exist in {name}")


def modal_system(
    models: Mapping[str, Model] | None = None, /, **named: Model
) -> ModalSystem:
    """The modal system of some possibilities, given as keywords or as a mapping.

    Raises `IllFormedError` where there is none, and where they are of different
    theories: they must share axioms, exclusions and open types.

    >>> Rain = Basic("Rain")
    >>> days = modal_system(mon=Model().given("s", Rain), tue=Model())
    >>> print(days.restrictive.possible(Rain))
    yes: something is of Rain in mon
    """
    found = combine_labels("modal_system", models, named)
    if not found:
        raise IllFormedError("a modal system has at least one possibility, found none")
    for name, model in found.items():
        if not isinstance(model, Model):
            raise IllFormedError(
                f"the possibility {name} must be a model, found {model!r}"
            )
    first, *rest = found
    for name in rest:
        if _assumptions(found[name]) != _assumptions(found[first]):
            raise IllFormedError(
                f"the possibilities {first} and {name} are of different theories",
                hint="build their models with the same Model(theory)",
            )
    return ModalSystem(tuple(found.items()), {})


def _assumptions(model: Model) -> tuple[object, ...]:
    theory = model.theory
    return theory.axioms, theory.exclusions, theory.opened
