"""Scenes by their kinds: what may be set of each, and how one is opened for a run."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from functools import partial
from random import Random

from kille.lab.scenes.occasions import Scene
from kille.lab.settings import Setting, Settings, filled
from kille.lab.study import Run, Study
from kille.lab.worlds.worlds import COLOURS, FRONTS, KINDS

WHOLE = frozenset({"rendered", "pictures", "captures"})
"""The kinds of scenes that the whole robot sees."""

MOST = 100
"""Things of a kind: more are nobody's study, but a slip."""


def _metres(default: float, about: str) -> Setting:
    """A length on a table that is not a metre wide; who means centimetres is told."""
    return Setting(float, default, most=1.0, unit="metres", about=about)


_NOISE: Settings = {
    "noise": Setting(
        float, 0.05, most=1.0, about="how much looks and things of a kind differ"
    ),
    "off": _metres(0.0, "the deviation of places as they are seen"),
    "astray": Setting(float, 0.0, most=1.0, about="the share of places seen anywhere"),
    "colours": Setting(str, "known", among=("known", "taught")),
}
_SPECIMENS: Settings = {
    "each": Setting(
        int, 1, least=1, most=MOST, about="things of each kind that are taught"
    ),
    "new": Setting(int, 1, most=MOST, about="things of each kind kept for later"),
}

SETTINGS: Mapping[str, Settings] = {
    "drawn": {
        **_NOISE,
        **_SPECIMENS,
        "kinds": Setting(str, KINDS, among=KINDS, several=True),
        "hues": Setting(str, tuple(COLOURS), among=tuple(COLOURS), several=True),
        "in_view": Setting(int, 1, least=1, most=100, about="things in view at once"),
    },
    "around": {
        **_NOISE,
        "target": Setting(str, "book", among=KINDS),
        "landmark": Setting(str, "car", among=KINDS),
        "front": Setting(str, "right", among=("", "any", *FRONTS)),
        "rings": Setting(
            float, (0.12, 0.28), least=0.02, most=0.45, several=True, unit="metres"
        ),
        "points": Setting(int, 8, least=1, most=1000, about="places on each ring"),
        "spread": _metres(0.01, "how exactly a thing is put there"),
        "shift": _metres(0.0, "how far the landmark has moved when asked"),
    },
    "statements": {
        "folder": Setting(str, needed=True, about="people's judgements of places"),
        "each": Setting(
            int, 8, least=1, about="statements of each word that are taught"
        ),
        "new": Setting(int, 8, about="statements of each word that are kept for later"),
        "words": Setting(str, (), several=True, about="only these words"),
        "colours": Setting(str, "known", among=("known", "taught")),
    },
    "rendered": {
        "kinds": Setting(str, (), several=True, about="all ten where none is named"),
        "each": Setting(
            int, 1, least=1, most=MOST, about="specimens of each kind that are taught"
        ),
        "new": Setting(
            int, 1, most=MOST, about="specimens of each kind that are kept for later"
        ),
        "target": Setting(str, "book"),
        "landmark": Setting(str, "car"),
        "faults": Setting(str, "all"),
    },
    "pictures": {
        "folder": Setting(str, needed=True, about="folders of pictures by category"),
        "each": Setting(int, 3, least=1, about="pictures of each word that are taught"),
        "new": Setting(int, 3, about="pictures of each word that are kept for later"),
        "kinds": Setting(str, (), several=True, about="all where none is named"),
    },
    "captures": {
        "folder": Setting(str, needed=True, about="folders of labelled captures"),
        "teach": Setting(str, (), several=True, about="the scenes that are taught"),
        "new": Setting(str, (), several=True, about="the scenes kept for later"),
        "each": Setting(int, 2, least=1, about="frames of each scene"),
    },
}
"""What may be set of scenes, kind by kind."""


def opened(study: Study, run: Run) -> Scene:
    """The scene of a run: drawn by its seed, whoever plays."""
    named = study.scenes[run.scene]
    set_ = filled(named.settings, SETTINGS[named.kind])
    chance = Random(f"scene {run.scene} {run.seed}")
    make = _maker(named.kind)
    if "folder" in set_:
        make = partial(make, study.folder / os.path.expanduser(set_["folder"]))
    return make(set_, chance)


def _maker(kind: str) -> Callable[..., Scene]:
    """What makes scenes of a kind. Eyes are imported by those who need them."""
    match kind:
        case "drawn":
            from kille.lab.scenes.drawn import drawn

            return drawn
        case "around":
            from kille.lab.scenes.around import around

            return around
        case "statements":
            from kille.lab.scenes.statements import statements

            return statements
        case "rendered":
            from kille.lab.scenes.rendered import rendered

            return rendered
    from kille.lab.scenes.captured import captures, pictures

    return {"pictures": pictures, "captures": captures}[kind]
