"""Names that something had until the last release: they still work, and warn.

>>> class Dog:
...     sound = "woof"
...     noise = Alias("sound")
>>> import warnings
>>> with warnings.catch_warnings(record=True) as said:
...     warnings.simplefilter("always")
...     Dog().noise
'woof'
>>> print(said[0].message)
Dog.noise is now Dog.sound
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from operator import attrgetter
from pkgutil import resolve_name
from types import ModuleType
from typing import Any
from warnings import warn

FORMER_MODULES = {
    "ttr.acts": "ttr.judging.type_acts",
    "ttr.claims": "ttr.semantics.propositional_entailment",
    "ttr.consent": "ttr.safety.consent",
    "ttr.contents": "ttr.semantics.parametric_content",
    "ttr.courses": "ttr.semantics.string_prediction",
    "ttr.encounters": "ttr.dialogues.encounters",
    "ttr.fragment": "ttr.semantics.fragment",
    "ttr.gameboards": "ttr.semantics.gameboards",
    "ttr.gameboards.ibis.terms": "ttr.semantics.gameboards.ibis.moves",
    "ttr.learning": "ttr.semantics.learning",
    "ttr.logs": "ttr.dialogues.logs",
    "ttr.perceptual": "ttr.semantics.perceptual",
    "ttr.possibilities": "ttr.semantics.modality",
    "ttr.propositions": "ttr.judging.propositions",
    "ttr.quantifiers": "ttr.semantics.quantifiers",
    "ttr.questions": "ttr.semantics.questions",
    "ttr.records": "ttr.types.records",
    "ttr.stories": "ttr.dialogues.stories",
    "ttr.strategies": "ttr.testing.strategies",
    "ttr.stratifying": "ttr.building.level_inference",
    "ttr.syntax": "ttr.types",
    "ttr.topoi": "ttr.semantics.topoi",
    "ttr.transcripts": "ttr.dialogues.transcripts",
    "ttr.updates.stepping": "ttr.updates.rule_application",
    "ttr.updates.writing": "ttr.updates.rule_notation",
    "ttr.variables": "ttr.semantics.random_variables",
}
"""Where the modules are now that users could know by another name."""


def _errors(names: str) -> dict[str, str]:
    """Error classes by the names that they had before they ended in Error.

    They are words in a text, so that nothing takes them for quoted names of today.
    """
    return {name: f"{name}Error" for name in names.split()}


_ERRORS = _errors(
    "Endless IllFormed NoState NotHeard Refused RuleFailed "
    "Undecided Unexpected Unsupported"
)

FORMER_NAMES: Mapping[str, Mapping[str, str]] = {
    "ttr": {
        "Answer": "ttr.computing:Answer",
        "Degree": "ttr.probability:Degree",
        "FunType": "ttr.types:FunType",
        "Function": "ttr.types:Function",
        "Join": "ttr.types:Join",
        "Judgement": "ttr.judging:Judgement",
        "Meet": "ttr.types:Meet",
        "NotationError": "ttr.errors:NotationError",
        "Operation": "ttr.types:Operation",
        "PType": "ttr.types:PType",
        "Path": "ttr.types:Path",
        "TooLargeError": "ttr.errors:TooLargeError",
        "TypeNode": "ttr.types:TypeNode",
        "UpdateError": "ttr.errors:UpdateError",
        "Why": "ttr.judging:Why",
        "common_supertype": "ttr.building:common_supertype",
        "fix": "ttr.building:fix",
        "flatten": "ttr.building:flatten",
        "join_normal_form": "ttr.computing:join_normal_form",
        "meet_normal_form": "ttr.computing:meet_normal_form",
        "proposition": "ttr.judging:proposition",
        "restrict": "ttr.building:restrict",
        "subtract": "ttr.building:subtract",
        "unflatten": "ttr.building:unflatten",
        "Endless": "ttr.errors:EndlessError",
        "IllFormed": "ttr.errors:IllFormedError",
        "NoState": "ttr.errors:NoStateError",
        "NotHeard": "ttr.errors:NotHeardError",
        "Refused": "ttr.errors:RefusedError",
        "RuleFailed": "ttr.errors:RuleFailedError",
        "Undecided": "ttr.errors:UndecidedError",
        "Unexpected": "ttr.errors:UnexpectedError",
        "Unsupported": "ttr.errors:UnsupportedError",
    },
    "ttr.dialogues.logs": {
        "continued": "continue_log",
        **_errors(" UnreadableLog"),
    },
    "ttr.dialogues.stories": {
        "Moment": "ttr.dialogues.dialogue:Trial",
        "failing": "failure_reason",
        "moment": "ttr.dialogues.dialogue:Trial.of",
        "worded": "wording",
        "written": "format_story",
    },
    "ttr.errors": _ERRORS | _errors(" Mistakes"),
    "ttr.judging.propositions": {"judged": "proposition_of"},
    "ttr.judging.type_acts": {"performed": "perform"},
    "ttr.probability": _errors("Contradiction Impossible")
    | {"shown": "format_probability"},
    "ttr.semantics.fragment": _errors(" OutsideFragment")
    | {
        "Inference": "ttr.computing:Answer",
        "picked_up": "pronoun_antecedents",
    },
    "ttr.semantics.gameboards.kos": {"said": "utterance"},
    "ttr.semantics.perceptual": {
        "detected": "detections",
        "individuated": "individuate",
    },
    "ttr.semantics.quantifiers": _errors(" Undefined") | {"judged": "judge_situation"},
    "ttr.semantics.questions": {"resolving": "find_answer"},
    "ttr.semantics.string_prediction": {"begun": "start_course"},
    "ttr.updates": {"replaced": "replace_rules"},
    "ttr.updates.rule_application": {"stepped": "apply_rule"},
    "ttr.updates.rule_notation": {"written": "format_rule"},
    "ttr.semantics.topoi": {"combined": "combine_topoi", "expected": "expectation"},
}
"""What was renamed in a module: its name there now, or where it is instead."""

_NEVER_WARN = ("ttr.Undecided", "ttr.errors.Undecided", "ttr.strategies")
"""Former names that may be used for good."""


class Alias:
    """A former name of an attribute or a method."""

    def __init__(self, now: str) -> None:
        self.now = now

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __get__(self, instance: object, owner: type) -> Any:
        """The value under the name it has now.

        >>> Alias("sound").now
        'sound'
        """
        which = owner.__name__
        message = f"{which}.{self.name} is now {which}.{self.now}"
        warn(message, DeprecationWarning, stacklevel=2)
        return attrgetter(self.now)(owner if instance is None else instance)


def former_names(
    module: str, names: Mapping[str, str] | None = None, stacklevel: int = 2
) -> Callable[[str], Any]:
    """The `__getattr__` of a module with former names; without `names`, `FORMER_NAMES`.

    Where another function calls it, one level of the stack more is passed over.

    >>> import warnings
    >>> from ttr.dialogues import stories
    >>> with warnings.catch_warnings(record=True) as said:
    ...     warnings.simplefilter("always")
    ...     stories.worded.__name__
    'wording'
    >>> print(said[0].message)
    ttr.dialogues.stories.worded is now ttr.dialogues.stories.wording
    """
    names = FORMER_NAMES[module] if names is None else names

    def find(name: str) -> Any:
        if name not in names:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        now = names[name] if ":" in names[name] else f"{module}:{names[name]}"
        if f"{module}.{name}" not in _NEVER_WARN:
            message = f"{module}.{name} is now {now.replace(':', '.')}"
            warn(message, DeprecationWarning, stacklevel=stacklevel)
        return resolve_name(now)

    return find


class _FormerModules(MetaPathFinder):
    """Finds modules, and what is in them, by the names that they had before."""

    def __init__(self, names: Mapping[str, str]) -> None:
        self.names = names

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None = None,
        target: ModuleType | None = None,
    ) -> ModuleSpec | None:
        """How to load a module that has another name now; None for all others."""
        former, inside = fullname, ""
        while former:
            if former in self.names:
                return ModuleSpec(fullname, _Renamed(self.names[former] + inside))
            former, _, last = former.rpartition(".")
            inside = f".{last}{inside}"
        return None


class _Renamed(Loader):
    def __init__(self, now: str) -> None:
        self.now = now

    def exec_module(self, module: ModuleType) -> None:
        """Puts the module that is meant in the place of the one to be loaded."""
        if module.__name__ not in _NEVER_WARN:
            message = f"{module.__name__} is now {self.now}"
            warn(message, DeprecationWarning, stacklevel=2)
        sys.modules[module.__name__] = import_module(self.now)


def find_former_modules(names: Mapping[str, str] = FORMER_MODULES) -> None:
    """From now on, imports of modules by their former names find them, with a warning.

    >>> import warnings
    >>> find_former_modules()
    >>> with warnings.catch_warnings(record=True) as said:
    ...     warnings.simplefilter("always")
    ...     from ttr.quantifiers.truth import truth
    >>> print(said[-1].message)
    ttr.quantifiers.truth is now ttr.semantics.quantifiers.truth
    """
    finders = [one for one in sys.meta_path if isinstance(one, _FormerModules)]
    if all(one.names is not names for one in finders):
        sys.meta_path.insert(0, _FormerModules(names))
