"""How the robot decides: by the expected utility of what it could say or do.

A strategy is a value in the state: the bands of certainty in which the robot asserts,
hedges, guesses …, and what it is worth to it to speak, to ask and to learn. The bands
follow from what being right and wrong is worth: the band of a way of speaking begins
where its expected utility exceeds that of the weaker ways.

Source: Lison 2013 (utilities decide what a robot says); Skočaj et al. 2011 (driven,
assisted and autonomous learning).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import PurePath
from typing import Any, NamedTuple

from kille.dialogue.language_files import (
    STRATEGIES,
    language_in,
    last_change,
    read_table,
)
from ttr import Record, record, replace
from ttr.aliases import former_names

__getattr__ = former_names(__name__, {"expected": "expected_value"})

__all__ = [
    "MODES",
    "TURNS",
    "WORDINGS",
    "Option",
    "Stake",
    "best",
    "expected_value",
    "strategy",
    "threshold",
]

MODES = ("driven", "assisted", "autonomous")
"""Who brings learning about: the tutor, both, or the robot as well by itself.

>>> from kille.dialogue.strategies import MODES
>>> MODES
('driven', 'assisted', 'autonomous')
"""

WORDINGS = ("paper", "four", "varied")
"""The ways to word what one is sure of: the paper's, the four bands after it, and the
paper's in varied words.

>>> from kille.dialogue.strategies import WORDINGS, strategy
>>> [strategy(wording=wording).bands.sure for wording in WORDINGS]
[0.6, 0.8, 0.6]
"""

TURNS = ("answering", "lively")
"""When the robot speaks: when it is spoken to, or also after some silence.

>>> from kille.dialogue.strategies import TURNS
>>> TURNS
('answering', 'lively')
"""

_NEVER = {"remark": 0.0, "ask": 0.0}
"""The silences of a robot that speaks when it is spoken to."""

_DIGITS = 9
"""Decimals of a threshold: what is worked out from decimals is one again."""


class Stake(NamedTuple):
    """What saying or doing something is worth, if it is right and if it is wrong.

    >>> bold, shy = Stake(right=1.0, wrong=-0.5), Stake(right=0.2, wrong=-0.1)
    >>> expected_value(bold, 0.6) > expected_value(shy, 0.6)
    True
    """

    right: float
    wrong: float


class Option(NamedTuple):
    """Something that could be done, how probably it is right, and what it is worth.

    >>> say = Option("say", p=0.9, stake=Stake(right=1.0, wrong=-1.0))
    >>> best([say]).name
    'say'
    """

    name: str
    p: float
    stake: Stake


def expected_value(stake: Stake, p: float) -> float:
    """The expected utility of something that is right with probability p.

    >>> expected_value(Stake(right=1.0, wrong=-1.0), 0.75)
    0.5
    """
    return p * stake.right + (1.0 - p) * stake.wrong


def best(options: Iterable[Option], nothing: float = 0.0) -> Option | None:
    """The option of the highest expected utility, the first of equals.

    None if no option is better than doing nothing, which is worth `nothing`.

    >>> ask = Option("ask", 0.5, Stake(1.0, -1.0))
    >>> say = Option("say", 0.9, Stake(1.0, -1.0))
    >>> best([ask, say]).name
    'say'
    >>> best([ask])
    """
    chosen = max(options, key=lambda it: expected_value(it.stake, it.p), default=None)
    if chosen is None or expected_value(chosen.stake, chosen.p) <= nothing:
        return None
    return chosen


def threshold(stronger: Stake, weaker: Stake) -> float:
    """The probability from which on the stronger stake pays at least as well.

    p·r₁ + (1 − p)·w₁ = p·r₂ + (1 − p)·w₂ at p = (w₂ − w₁) / ((r₁ − w₁) − (r₂ − w₂)).
    Where it never is, 1 and more; where it always is, 0.

    >>> threshold(Stake(1.0, -1.0), Stake(0.0, 0.0))
    0.5
    """
    steeper = (stronger.right - stronger.wrong) - (weaker.right - weaker.wrong)
    behind = weaker.wrong - stronger.wrong
    if steeper <= 0.0:
        return 2.0 if behind > 0.0 else 0.0
    return max(0.0, round(behind / steeper, _DIGITS))


def strategy(
    mode: str = "", wording: str = "", language: str = "en", turns: str = ""
) -> Record:
    """A strategy of `strategies.toml`: by default the one that it names there.

    The file is that of the package, or else in the folder of a language of one's own.
    A file without a table of `turns` lets the robot speak when it is spoken to.

    Raises `ValueError` for a mode, a wording or turns that it does not have.

    >>> bands = strategy(wording="four").bands
    >>> bands.sure, bands.think, bands.likely
    (0.8, 0.5, 0.3)
    """
    folder = PurePath(language).parent.as_posix()
    changed = last_change(STRATEGIES, language)
    return _strategy(mode, wording, turns, folder, changed)


def reckon_with_strangers(s: Record, share: float) -> Record:
    """The state where so many of the things that are asked about may be strange.

    >>> from kille.dialogue.state import initial
    >>> reckon_with_strangers(initial(), 0.25).private.strategy.strangers
    0.25
    """
    if s.private.strategy.strangers == share:
        return s
    return replace(s, {"private.strategy.strangers": share})


@lru_cache
def _strategy(mode: str, wording: str, turns: str, folder: str, _: int) -> Record:
    data = _data(folder)
    turns = turns or data["default"].get("turns", TURNS[0])
    silences = _look_up(data.get("turns", {TURNS[0]: _NEVER}), turns)
    mode = mode or data["default"]["mode"]
    wording = wording or data["default"]["wording"]
    wants, words = _look_up(data["modes"], mode), _look_up(data["wordings"], wording)
    if "like" in words:
        words = {**_look_up(data["wordings"], words["like"]), **words}
    learning = Stake(**wants["learning"])
    return record(
        mode=mode,
        wording=wording,
        bands=record(_bands(words)),
        examples=float(words["examples"]),
        yes_below=words["yes_below"],
        no_below=words["no_below"],
        hearing=record(data["hearing"]),
        wants=record(
            {name: it for name, it in wants.items() if name != "learning"},
            learning=record(learning._asdict()),
        ),
        turns=record(silences, name=turns),
        salience=record(_weights(data)),
        strangers=0.5,
    )


def _weights(data: Mapping[str, Any]) -> dict[str, Any]:
    """What makes things salient; what a file does not say is as in the package's."""
    usual, own = _data()["salience"], data.get("salience", {})
    return {
        name: record({**it, **own.get(name, {})})
        if isinstance(it, Mapping)
        else own.get(name, it)
        for name, it in usual.items()
    }


def _bands(words: Mapping[str, Any]) -> dict[str, float]:
    """The bands that follow from the stakes of a wording, and those that are set."""
    stakes = {name: Stake(**it) for name, it in words["stakes"].items()}
    likely = threshold(stakes["doubt"], Stake(0.0, 0.0))
    think = max(likely, threshold(stakes["think"], stakes["doubt"]))
    sure = max(think, threshold(stakes["assert"], stakes["think"]))
    set_ = ("margin", "might", "probable", "unlikely")
    return {
        "sure": sure,
        "think": think,
        "likely": likely,
        "name_margin": words.get("name_margin", words["margin"]),
        **{name: words[name] for name in set_},
    }


def _look_up(table: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    if name not in table:
        raise ValueError(f"there is no {name}: choose one of {', '.join(table)}")
    found: Mapping[str, Any] = table[name]
    return found


def _data(folder: str = ".") -> Mapping[str, Any]:
    """What is in the file of strategies of a folder, or else of the package."""
    return read_table(STRATEGIES, language_in(folder, "en"))
