"""The errors of `ttr`: each says what is wrong, where, and how to mend it.

Every error is a `TTRError`: one sentence that says what was expected and what was
found, with the place in the text and a way out where they are known.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ttr.aliases import former_names
from ttr.escapes import columns, terminal_line, terminal_text
from ttr.misspellings import nearest_names

__all__ = [
    "EndlessError",
    "IllFormedError",
    "MistakesError",
    "NoStateError",
    "NotHeardError",
    "NotationError",
    "RefusedError",
    "RuleFailedError",
    "Span",
    "TTRError",
    "TooLargeError",
    "UndecidedError",
    "UnexpectedError",
    "UnsupportedError",
    "UpdateError",
    "suggestion",
]


_SHOWN = 120
"""How many characters of a line are shown around a place."""


@dataclass(frozen=True)
class Span:
    """A place in a text: where it came from, line and column from 1, length."""

    source: str
    line: int
    column: int
    length: int
    text: str

    @classmethod
    def of(cls, source: str, text: str, start: int, end: int) -> Span:
        r"""The span of text[start:end]; a span over several lines ends with its first.

        >>> Span.of("a.ttr", "basic Ind\nX := Idn", 15, 18).line
        2
        """
        start = min(start, len(text))
        line_start = text.rfind("\n", 0, start) + 1
        line_end = text.find("\n", start)
        line_end = len(text) if line_end < 0 else line_end
        length = max(1, min(end, line_end) - start)
        line = text.count("\n", 0, start) + 1
        shown = text[line_start:line_end].replace("\t", " ")
        return cls(source, line, start - line_start + 1, length, shown)

    def __str__(self) -> str:
        """The place, then the line with the span underlined; a long line is cut."""
        gutter = " " * len(str(self.line))
        first = self.column - 1
        start = max(0, first - _SHOWN // 2) if len(self.text) > _SHOWN else 0
        end = start + _SHOWN
        last = min(first + self.length, end)
        before = "…" * (start > 0) + terminal_line(self.text[start:first])
        marked = terminal_line(self.text[first:last])
        after = terminal_line(self.text[last:end]) + "…" * (end < len(self.text))
        beyond = max(0, last - max(first, len(self.text)))
        caret = " " * columns(before) + "^" * max(1, columns(marked) + beyond)
        return (
            f"{gutter} ┌─ {terminal_line(self.source)}:{self.line}:{self.column}\n"
            f"{self.line} │ {before}{marked}{after}\n"
            f"{gutter} │ {caret}"
        )


class TTRError(Exception):
    """Something that type theory, notation or an update rule does not allow.

    `message` says what, in one line, and `hint` what to do; `span` is where it stands
    in a text, if it was read from one.

    >>> from ttr import parse
    >>> try:
    ...     parse("[x : ]")
    ... except TTRError as error:
    ...     print(error.span is not None)
    True
    """

    def __init__(self, message: str, *, span: Span | None = None, hint: str = ""):
        super().__init__(message)
        self.message = message
        self.span = span
        self.hint = hint

    def at(self, span: Span) -> TTRError:
        """The same error with its place, if it has none yet."""
        return (
            self if self.span else type(self)(self.message, span=span, hint=self.hint)
        )

    def __str__(self) -> str:
        """The message, the place and the hint, safe to print."""
        lines = [terminal_text(self.message)]
        if self.span:
            lines.append(str(self.span))
        if self.hint:
            lines.append(f"help: {terminal_text(self.hint)}")
        return "\n".join(lines)

    def __reduce__(self) -> tuple[object, ...]:
        return _rebuild, (type(self), self.message, self.span, self.hint)


def _rebuild(
    kind: type[TTRError], message: str, span: Span | None, hint: str
) -> TTRError:
    return kind(message, span=span, hint=hint)


class NotationError(TTRError):
    """A text that the notation does not allow: what was expected, what was found.

    >>> import ttr
    >>> ttr.parse("[x : Ind, c : dog(x)")
    Traceback (most recent call last):
        ...
    ttr.errors.NotationError: expected a comma or ], found the end of the text
      ┌─ <text>:1:21
    1 │ [x : Ind, c : dog(x)
      │                     ^
    """


class MistakesError(NotationError):
    r"""Several mistakes in one theory; `errors` has them in the order of the text.

    >>> import ttr
    >>> try:
    ...     ttr.Theory.parse("pred dog(Ind)\nDog := [x : Ind, c : dgo(x)]")
    ... except MistakesError as wrong:
    ...     print(len(wrong.errors))
    2
    """

    errors: tuple[TTRError, ...] = ()

    @classmethod
    def of(cls, errors: tuple[TTRError, ...]) -> MistakesError:
        """The mistakes as one error."""
        error = cls(f"{len(errors)} mistakes\n\n" + "\n\n".join(map(str, errors)))
        error.errors = errors
        return error

    def __reduce__(self) -> tuple[object, ...]:
        return MistakesError.of, (self.errors,)


class IllFormedError(TTRError):
    """A type that cannot be built: wrong arity, wrong domain, path to nowhere.

    >>> from ttr import Ind, Pred
    >>> Pred("hug", Ind, Ind)("sam")
    Traceback (most recent call last):
        ...
    ttr.errors.IllFormedError: hug takes 2 arguments (Ind, Ind), but has 1
    """


class RefusedError(TTRError):
    """A judgement that a witness condition or a fact contradicts.

    >>> from ttr import Basic, Model
    >>> Real = Basic("Real")
    >>> M = Model().witnessed(Real, by=lambda it: isinstance(it, float))
    >>> M.given("fido", Real)
    Traceback (most recent call last):
        ...
    ttr.errors.RefusedError: fido : Real is refused by the witness function of Real
    """


class UnexpectedError(RefusedError):
    """An event that does not fit the course of events where it comes.

    >>> from ttr import Basic, Model, Plus
    >>> from ttr.semantics.string_prediction import start_course
    >>> Step = Basic("Step")
    >>> course = start_course(Plus(Step), Model().given("e1", Step))
    >>> course.seen("e1").seen("e2")
    Traceback (most recent call last):
        ...
    ttr.errors.UnexpectedError: event 2, e2, is of nothing that is known, but expected:
    Step
    help: ask expects(event) how probable it is that it fits
    """


class UndecidedError(TTRError):
    """A yes or no was asked of a judgement that is neither certain nor refuted.

    >>> from ttr import Ind, Model
    >>> Model().given("fido", Ind, 0.7).judge("fido", Ind).holds
    Traceback (most recent call last):
        ...
    ttr.errors.UndecidedError: fido : Ind   p = 0.7 is neither certain nor refuted
    help: ask for a degree with j.at_least(q), or look at j.p
    """


class UnsupportedError(TTRError):
    """An operation that is not defined for a constructor.

    >>> from ttr import Ind, ListOf, Model
    >>> from ttr.semantics.string_prediction import start_course
    >>> start_course(ListOf(Ind), Model())
    Traceback (most recent call last):
        ...
    ttr.errors.UnsupportedError: list(Ind) is no type of strings that can be predicted
    help: write one with str(…), plus(…) or star(…), without paths outwards
    """


class TooLargeError(TTRError):
    """A question that needs more steps than its budget allows.

    >>> from ttr import Ind, Pred, budget
    >>> from ttr.computing import join_normal_form
    >>> p, q = Pred("p", Ind), Pred("q", Ind)
    >>> T = (p("a") | q("a")) & (p("b") | q("b")) & (p("c") | q("c"))
    >>> with budget(steps=10):
    ...     join_normal_form(T)
    Traceback (most recent call last):
        ...
    ttr.errors.TooLargeError: too large: it takes more than 10 steps, and ended in
    `join_normal_form`
    help: ask for less, or allow more steps (ttr.budget, or --steps)
    """


class UpdateError(TTRError):
    """A rule, a state or an event with which an update cannot go on.

    `steps` are the rules that had been applied in the same turn, as far as is known.

    >>> from ttr.updates import first
    >>> first("greet")
    Traceback (most recent call last):
        ...
    ttr.errors.UpdateError: first takes rules and strategies, found 'greet'
    """

    steps: tuple[Any, ...] = ()


class NoStateError(UpdateError):
    """Something that is not of the type of the information states.

    >>> from ttr import Model, Theory, record
    >>> from ttr.updates import run
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> run(talk.rules["drop"], record(qud="dog"), type=talk.Board, model=Model())
    Traceback (most recent call last):
        ...
    ttr.errors.NoStateError: before the first rule the state is not of its type, at qud:
    dog : list(Question), it is no list
    """


class RuleFailedError(UpdateError):
    """A rule that raised an error, or gave what no state can be made of.

    >>> from ttr import Model, Rec, record
    >>> from ttr.updates import rule, run
    >>> @rule(when=Rec)
    ... def divide(s):
    ...     return 1 / 0
    >>> run(divide, record(), type=Rec, model=Model())
    Traceback (most recent call last):
        ...
    ttr.errors.RuleFailedError: the rule divide failed: ZeroDivisionError: division by
    zero
    """


class EndlessError(UpdateError):
    """A repetition or an agenda that never ends.

    >>> from ttr import Model, Rec, record
    >>> from ttr.updates import repeat, rule, run
    >>> @rule(when=Rec)
    ... def wait(s):
    ...     return s
    >>> run(repeat(wait), record(), type=Rec, model=Model())
    Traceback (most recent call last):
        ...
    ttr.errors.EndlessError: wait is repeated without changing anything
    help: let its precondition fail once its work is done
    """


class NotHeardError(UpdateError):
    """An event of a type that no rule takes.

    >>> from ttr import Ind, Model
    >>> from ttr.semantics.gameboards import kos
    >>> game = kos.game(Model().given("a", Ind).given("b", Ind), "a", "b")
    >>> game.take(game.begin(), "cough")
    Traceback (most recent call last):
        ...
    ttr.errors.NotHeardError: cough is no event that the game a dialogue gameboard
    takes: expected [addr : Ind, move : Move, spkr : Ind]
    """


def suggestion(name: str, known: Iterable[str]) -> str:
    """A hint for an unknown name: the nearest known one; empty if none is near.

    >>> suggestion("hgu", ["hug", "dog"])
    'did you mean hug?'
    >>> suggestion("zebra", ["hug", "dog"])
    ''
    """
    near = nearest_names(name, known)
    return f"did you mean {near[0]}?" if near else ""


def describe_error(error: BaseException) -> str:
    """The class of an error and its message, on one line.

    >>> describe_error(ValueError("of two\\nlines")), describe_error(KeyError())
    ('ValueError: of two lines', 'KeyError')
    """
    said = " ".join(str(error).split())
    return f"{type(error).__name__}: {said}" if said else type(error).__name__


if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)
