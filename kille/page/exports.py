"""A turn or the dialogue as a file: a story, a log, and the state as LaTeX."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime

from kille.agent.agent import Agent
from kille.agent.exchanges import Event, Exchange
from kille.agent.story_log import event_lines, head_lines
from kille.dialogue.language import LANGUAGES
from kille.dialogue.language_files import plain
from kille.page.state_changes import PARTS, Insight
from ttr import Record, latex, record

FORMATS = ("dlg", "log", "tex")


def file_name(robot: Agent, kind: str, turn: int | None) -> str:
    """What the file of a turn, or of the dialogue, is called."""
    spoken = plain(robot.language)
    language = "" if kind != "dlg" or spoken == LANGUAGES[0] else f".{spoken}"
    what = "dialogue" if turn is None else f"turn-{turn}"
    return f"kille-{what}{language}.{kind}"


def story_text(robot: Agent, events: Iterable[Event], began: datetime) -> str:
    """The events as a story, as `kille talk --log` writes them."""
    strategy = robot.state.private.strategy
    chosen = (strategy.mode, strategy.wording, strategy.turns.name)
    lines = head_lines(robot.gaze.sensor.name, began, chosen)
    lines += [line for event in events for line in event_lines(event, began)]
    return "".join(f"{line}\n" for line in lines)


def log_text(turns: Iterable[Exchange], insight: Insight) -> str:
    """What was said, with the derivation of each turn, as `@ trace` shows it."""
    lines: list[str] = []
    for turn in turns:
        lines.append(f"U> {turn.text}" if turn.text else "@ look")
        lines += [f"     {kind:>6}  {text}" for kind, text in insight.derive(turn)]
        lines += [f"S> {it.text}" for it in turn.said]
    return "".join(f"{line}\n" for line in lines)


def state_as_latex(state: Record, insight: Insight) -> str:
    r"""The state as matrices, one for each of its parts, without empty fields.

    >>> from kille.dialogue.state import initial
    >>> text = state_as_latex(initial(), Insight())
    >>> print(text.splitlines()[0])
    % Needs \usepackage{amsmath}.
    """
    lines = [r"% Needs \usepackage{amsmath}."]
    short = insight.shorten(state)
    assert isinstance(short, Record)
    for name in PARTS:
        part = short[name]
        full = {it: part[it] for it in part if part[it] not in ((), record(), "")}
        lines += [r"\[", rf"\mathrm{{{name}}} = {latex(record(full))}", r"\]"]
    return "".join(f"{line}\n" for line in lines)
