"""`ttr repl`: the reply to each input, and the commands after a colon.

`respond` is a function from a session and an input to a reply; the loop that reads
lines and prints is in `ttr.cli.session.terminal`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial, reduce
from pathlib import Path

from ttr.cli.session.replies import Reply, answer, evaluate_term, list_changes
from ttr.cli.session.sessions import Session, load_file, save_file
from ttr.computing.normalisation import normal_form
from ttr.computing.subtyping import Answer
from ttr.display.render import box, latex
from ttr.errors import TTRError, suggestion
from ttr.judging.judgements import Judgement
from ttr.safety.budgets import within_budget
from ttr.theories.theory import Theory
from ttr.types.printing import notation
from ttr.types.syntax import Pred


def respond(session: Session, text: str) -> Reply:
    """The reply to an input, and the session after it.

    A mistake is a reply, too, and leaves the session as it was.

    >>> session = respond(Session(), "basic Ind").session
    >>> print(respond(session, "[x : Idn]").text)
    error: nothing is called Idn here
      ┌─ <input>:1:6
    1 │ [x : Idn]
      │      ^^^
    help: did you mean Ind?
    """
    text = text.strip()
    try:
        if text.startswith(":"):
            return _run_command(session, text)
        if text in _WITHOUT_COLON and text not in session.theory.names:
            raise TTRError(f"{text} is no command here", hint=_COMMANDS_ARE)
        return answer(session, text) if _says_something(text) else Reply(session)
    except TTRError as error:
        return Reply(session, f"error: {error}")


_WITHOUT_COLON = ("exit", "quit", "help", "?")
"""Words that are commands in other programs."""

_COMMANDS_ARE = ":help lists the commands, :quit ends"


def _says_something(text: str) -> bool:
    """Is there anything but comments?"""
    return any(line.strip()[:1] not in ("", "#") for line in text.splitlines())


# --- whether an input is whole -------------------------------------------------------

_SIGNS = re.compile(
    r"""(?P<quoted> "(?:\\.|[^"\\\n])*"? | '(?:\\.|[^'\\\n])*'? )
      | \#[^\n]*
      | (?P<opening> [\[({] )
      | (?P<closing> [\])}] )
      | (?P<operator> := | <: | <= | -> | /\\ | \\/ | (?<=[\w)]) \.(?!\w)
                      | [:=&|+@~,\\∧∨¬→⊑λ] )
      | (?P<word> [^\s] )""",
    re.VERBOSE,
)


_PROMISES = re.compile(r"\s*(rule|game)\s+\w+\s*\(")


@dataclass(frozen=True)
class Pending:
    """The state of an input after some of its lines, so that each is scanned once.

    `depth` is the number of open brackets, `last` the kind of the last sign;
    `is_promised` holds of a rule or a game before its `:=`.
    """

    depth: int = 0
    last: str = ""
    is_command: bool = False
    is_promised: bool = False

    def after(self, line: str) -> Pending:
        """The state after one more line."""
        depth, last = self.depth, self.last
        is_promised = self.is_promised or (not last and bool(_PROMISES.match(line)))
        for found in _SIGNS.finditer(line):
            kind = found.lastgroup
            depth += (kind == "opening") - (kind == "closing")
            last = kind or last
            is_promised = is_promised and found[0] != ":="
        begins_here = not self.last and line.lstrip().startswith(":")
        is_command = self.is_command or begins_here
        return Pending(depth, last, is_command, is_promised)

    @property
    def is_complete(self) -> bool:
        """Does the input end here?"""
        waits = self.last == "operator" and not self.is_command
        return self.depth <= 0 and not waits and not self.is_promised


def is_complete(text: str) -> bool:
    r"""Does an input end here? No bracket is open, and no operator stands last.

    >>> [is_complete(t) for t in ("Ind", "[x : Ind,", "Dog :=", r"\x:Ind.", ")")]
    [True, False, False, False, True]
    """
    return reduce(Pending.after, text.split("\n"), Pending()).is_complete


# --- commands ------------------------------------------------------------------------


@within_budget
def _run_command(session: Session, text: str) -> Reply:
    word, _, argument = text[1:].partition(" ")
    command = COMMANDS.get(word)
    if command is None:
        raise TTRError(
            f"there is no command :{word}",
            hint=suggestion(f":{word}", map(":{}".format, COMMANDS)) or _COMMANDS_ARE,
        )
    if command.takes == "" and argument.strip():
        raise TTRError(f":{word} stands alone, found {argument.strip()}")
    if command.takes[:1].isupper() and not argument.strip():
        raise TTRError(f":{word} needs a {command.takes.lower()}")
    return command.run(session, argument.strip())


def _box(session: Session, argument: str) -> Reply:
    return _draw(session, argument, partial(box, theory=session.theory))


def _latex(session: Session, argument: str) -> Reply:
    return _draw(session, argument, partial(latex, theory=session.theory))


def _draw(session: Session, argument: str, draw: Callable[[object], str]) -> Reply:
    value = evaluate_term(session, argument) if argument else session.last
    if value is None or isinstance(value, Answer):
        raise TTRError("there is nothing to draw", hint="name a type or an object too")
    return Reply(session, draw(value))


def _normal(session: Session, argument: str) -> Reply:
    value = evaluate_term(session, argument) if argument else session.last
    if value is None or isinstance(value, Answer | Judgement):
        raise TTRError("there is nothing to compute", hint="name a type or an object")
    found = normal_form(value, session.theory)
    return Reply(replace(session, last=found), notation(found, session.theory.spelling))


def _why(session: Session, _: str) -> Reply:
    match session.last:
        case Judgement() as judgement:
            return Reply(session, str(judgement.why))
        case Answer() as answer:
            against = answer.counter
            grounds = [str(against.why)] if against is not None else []
            return Reply(session, "\n".join([str(answer), *grounds]))
    raise TTRError("there is no answer to explain", hint="ask a : T or S <= T first")


def _names(session: Session, _: str) -> Reply:
    return Reply(
        session, "\n".join(_names_by_kind(session.theory)) or "no name is declared"
    )


def _names_by_kind(theory: Theory) -> Iterator[str]:
    """A line for each kind of declaration, with the names."""
    arities = [one for pred in theory.predicates.values() for one in _arities(pred)]
    kinds = {
        "basic": theory.basics,
        "pred": arities,
        "object": sorted(theory.objects),
        "defined": theory.definitions,
        "rule": theory.rules,
        "strategy": theory.strategies,
        "game": theory.openings,
    }
    for kind, names in kinds.items():
        if names:
            yield f"{kind:<7} {', '.join(names)}"


def _arities(pred: Pred) -> Iterator[str]:
    for arity in pred.arities:
        yield f"{pred.name}({', '.join(map(str, arity))})"


def _load(session: Session, argument: str) -> Reply:
    after, changed = load_file(session, Path(argument).expanduser())
    count = len(after.theory.names)
    said = f"{argument}: the session has {count} name{'s' * (count != 1)}"
    told = "\n".join(filter(None, (said, list_changes(changed))))
    return Reply(replace(after, before=session), told)


def _save(session: Session, argument: str) -> Reply:
    save_file(session, Path(argument).expanduser())
    count = len(session.entries)
    return Reply(session, f"{argument}: {count} statement{'s' * (count != 1)}")


def _undo(session: Session, _: str) -> Reply:
    if session.before is None:
        raise TTRError("there is nothing to undo")
    return Reply(session.before, "undone")


def _help(session: Session, _: str) -> Reply:
    rows = [(f":{name} {one.takes}", one.does) for name, one in COMMANDS.items()]
    listed = "\n".join(f"  {left:<15}{right}" for left, right in (*_TYPED, *rows))
    return Reply(
        session, f"Type a statement, a question, a term or a command.\n{listed}"
    )


def _quit(session: Session, _: str) -> Reply:
    return Reply(replace(session, over=True))


_TYPED = (
    ("basic Ind", "declare a basic type; also pred dog(Ind), object fido : Ind"),
    ("Dog := T", "define a name; declared again, what rests on it follows"),
    ("given a : T", "a fact, also with a degree: given a : T = 0.7"),
    ("S <: T", "an axiom"),
    ("rule r(s : S)", "… := T, a rule of update; also strategy n := …, game g(…) := …"),
    ("a : T, S <= T", "is it so? also S = T, merge(S, T) = U, wellformed(T)"),
    ("merge(S, T)", "what it comes to; also amerge(S, T), f(a)"),
    ("r(s, e), g(e)", "the state that a rule gives; the turns of a game"),
    ("create(T)", "make a witness and keep it; witnesses(T) lists the known ones"),
)
"""Inputs that are no commands, and what they do."""


@dataclass(frozen=True)
class Command:
    """A command after a colon; `takes` is its argument, in brackets if optional."""

    run: Callable[[Session, str], Reply]
    takes: str
    does: str


COMMANDS: Mapping[str, Command] = {
    "box": Command(_box, "[T]", "draw a type or an object, or else the last answer"),
    "latex": Command(_latex, "[T]", "the same for a paper"),
    "normal": Command(_normal, "[T]", "what a type or an object computes to"),
    "why": Command(_why, "", "the derivation of the last answer"),
    "names": Command(_names, "", "what is declared"),
    "load": Command(_load, "FILE", "read a theory into the session"),
    "save": Command(_save, "FILE", "write the session's statements as a theory"),
    "undo": Command(_undo, "", "take back the last change"),
    "help": Command(_help, "", "show these lines"),
    "quit": Command(_quit, "", "end; so does Ctrl-D"),
}
"""The commands, by the words that call them."""
