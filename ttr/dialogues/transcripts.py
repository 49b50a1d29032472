"""Transcripts: dialogues as a page, with the state beside each turn.

The page is one file with its own style; it has no script and fetches nothing. Fields
that a turn changed are marked, and the rules that changed them open on a click.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from warnings import warn

from ttr.dialogues.dialogue import Dialogue, Trial
from ttr.dialogues.settings import Setting
from ttr.display.abbreviations import abbreviator
from ttr.display.differences import layout_of_changes
from ttr.display.html import STYLE, page, part_of_page
from ttr.escapes import html_text
from ttr.safety.budgets import within_budget
from ttr.types.objects import Object
from ttr.types.printing import notation
from ttr.types.records import differences
from ttr.updates import Run, Step

__all__ = ["transcript"]


def Transcribed(
    title: str,
    setting: Setting,
    start: Run,
    moments: Iterable[Trial],
    ending: str = "",
) -> Dialogue:
    """A dialogue for a page: the former name, before there was `Dialogue`."""
    message = "Transcribed is now ttr.dialogues.dialogue.Dialogue"
    warn(message, DeprecationWarning, stacklevel=2)
    return Dialogue(setting.game, tuple(moments), title, setting, start, ending)


@within_budget
def transcript(title: str, dialogues: Iterable[Dialogue]) -> str:
    """The HTML page of some dialogues.

    What the theory of a game defines is shown by its name.

    >>> from ttr import Theory
    >>> from ttr.testing import play
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> page = transcript("One name", [play(theory.games["notes"], ["ann"])])
    >>> "<h1>One name</h1>" in page
    True
    """
    shown = [dialogue.in_words() for dialogue in dialogues]
    parts = [f"<h1>{html_text(title)}</h1>"]
    if len(shown) > 1:
        parts.append(_contents(shown))
    parts += [_section(number, one) for number, one in enumerate(shown, start=1)]
    return page(title, f"<main>{''.join(parts)}</main>", STYLE + _STYLE)


def _contents(dialogues: list[Dialogue]) -> str:
    items = [
        f'<li><a href="#d{number}">{html_text(one.title)}</a>'
        f"{_difference_mark(one)}</li>"
        for number, one in enumerate(dialogues, start=1)
    ]
    return f"<nav><ol>{''.join(items)}</ol></nav>"


def _difference_mark(one: Dialogue) -> str:
    return ' <span class="differs">differs</span>' if one.ending else ""


def _section(number: int, one: Dialogue) -> str:
    fold = abbreviator(one.setting.theory, 0)
    before: Object = fold(one.start.state)
    start = _article(f"d{number}t0", "", "<p>the start</p>", before, before)
    parts = [
        f'<h2 id="d{number}">{html_text(one.title)}{_difference_mark(one)}</h2>',
        start,
    ]
    for turn, trial in enumerate(one.trials, start=1):
        after = fold(trial.after.state)
        told = _utterances(trial) + _rule_list(trial.steps, fold)
        parts.append(_article(f"d{number}t{turn}", str(turn), told, before, after))
        before = after
    if one.ending:
        parts.append(f'<pre class="ending">{html_text(one.ending)}</pre>')
    return f"<section>{''.join(parts)}</section>"


def _article(name: str, number: str, told: str, before: Object, after: Object) -> str:
    link = f'<a class="number" href="#{name}">{number}</a>' if number else ""
    state = part_of_page(layout_of_changes(before, after))
    return (
        f'<article id="{name}">{link}<div class="talk">{told}</div>'
        f'<div class="state">{state}</div></article>'
    )


def _utterances(trial: Trial) -> str:
    mark, _, words = trial.line.partition(" ")
    lines = [_utterance("heard", mark, words or "(nothing)")]
    lines += [_utterance("said", "S>", words) for words in trial.said]
    return "".join(lines)


def _utterance(kind: str, mark: str, words: str) -> str:
    return (
        f'<p class="{kind}"><span class="mark">{html_text(mark)}</span> '
        f"{html_text(words)}</p>"
    )


def _rule_list(trace: Iterable[Step], fold: Callable[[Object], Object]) -> str:
    steps = [_rule_item(step, fold) for step in trace]
    if not steps:
        return '<p class="none">no rule applied</p>'
    told = "1 rule" if len(steps) == 1 else f"{len(steps)} rules"
    inside = "".join([f"<li>{step}</li>" for step in steps])
    return f"<details><summary>{told}</summary><ol>{inside}</ol></details>"


def _rule_item(step: Step, fold: Callable[[Object], Object]) -> str:
    lines = [f"{k} = {notation(fold(v))}" for k, v in step.bindings.items()]
    if step.event is not None and step.p.lo < 1.0:
        lines.insert(0, f"on {notation(step.event)}   p = {step.p}")
    changes = differences(fold(step.before), fold(step.after))
    doc, told = html_text(step.rule.doc), "\n".join([*lines, *changes])
    return (
        f'<b class="rule">{html_text(step.rule.name)}</b>'
        + f'<div class="doc">{doc}</div>' * bool(doc)
        + f"<pre>{html_text(told or 'nothing changed')}</pre>"
    )


_STYLE = """
:root { color-scheme: light dark; --line: #8886; --soft: #8881; --mark: #b3261e; }
body { margin: 0; font: 1rem/1.5 system-ui, sans-serif; }
main { max-width: 72rem; margin: auto; padding: 1rem; }
h1 { font-size: 1.5rem; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2rem 0 .5rem; }
article { display: grid; grid-template-columns: 2rem minmax(0, 1fr) minmax(0, 1.2fr);
  gap: .75rem; border-top: 1px solid var(--line); padding: .75rem 0; }
article:target { background: var(--soft); }
.number { grid-column: 1; color: inherit; opacity: .7; text-decoration: none; }
.talk { grid-column: 2; }
.state { grid-column: 3; overflow-x: auto; font-size: .9rem; }
.talk p { margin: 0 0 .3rem; overflow-wrap: anywhere; }
.mark { font-family: ui-monospace, monospace; opacity: .7; }
.said { font-weight: 600; }
.said .mark { font-weight: 400; }
.none, details { font-size: .9rem; }
.none { opacity: .7; }
summary { cursor: pointer; }
ol { margin: .3rem 0; padding-left: 1.4rem; }
.rule { font-family: ui-monospace, monospace; }
.doc { white-space: pre-line; }
pre { margin: .2rem 0 .6rem; white-space: pre-wrap; overflow-wrap: anywhere;
  font: .85rem/1.45 ui-monospace, monospace; }
.ending { border-left: 4px solid var(--mark); padding: .5rem .75rem;
  background: var(--soft); }
.differs { color: var(--mark); font-size: .85rem; font-weight: 600; }
@media (prefers-color-scheme: dark) { :root { --mark: #ff8a80; } }
@media (max-width: 45rem) {
  article { grid-template-columns: 1.5rem minmax(0, 1fr); }
  .state { grid-column: 2; }
}
"""
