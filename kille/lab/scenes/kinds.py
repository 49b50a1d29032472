"""Scenes by their kinds: what may be set of each, how one is opened, and what is wrong.

What only the disk, or the rest of the study, can tell is found by `faults`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from random import Random
from urllib.parse import quote

from kille.lab.errors import StudyError
from kille.lab.results import ExperimentError
from kille.lab.scenes.scene import KINDS as WORDS
from kille.lab.scenes.scene import Scene
from kille.lab.settings import (
    Problem,
    Setting,
    Settings,
    fill_settings,
    suggest_name,
    why_no_folder,
)
from kille.lab.study import Named, Run, Study
from kille.lab.worlds.worlds import COLOURS, FRONTS, KINDS
from kille.sensors.sensor import SensorError

WHOLE = frozenset({"rendered", "pictures", "captures"})
"""The kinds of scenes that the whole robot sees.

>>> from kille.lab.scenes import WHOLE
>>> sorted(WHOLE)
['captures', 'pictures', 'rendered']
"""

MOST = 100
"""Things of a kind: more are nobody's study, but a slip."""


def _metres(default: float, about: str) -> Setting:
    """A length in metres; centimetres would be too large for the table."""
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
        "alike": Setting(
            bool,
            False,
            about="whether taught things of a kind have one colour and size",
        ),
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
"""What may be set of scenes, kind by kind.

>>> from kille.lab.scenes import SETTINGS
>>> "kinds" in SETTINGS["drawn"]
True
"""


def open_scene(study: Study, run: Run) -> Scene:
    """The scene of a run: drawn by its seed, whoever plays.

    >>> from pathlib import Path
    >>> from kille.lab.study_files import parse
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "teach"
    ... '''
    >>> cups = parse(text, Path("cups.toml"))
    >>> open_scene(cups, next(cups.runs())).start.thing(1).kind
    'cup'
    """
    named = study.scenes[run.scene]
    set_ = fill_settings(named.settings, SETTINGS[named.kind])
    chance = Random(f"scene {run.scene} {run.seed}")
    make = _opener(named.kind)
    if "folder" in set_:
        make = partial(make, study.path(set_["folder"]))
    return make(set_, chance)


def _opener(kind: str) -> Callable[..., Scene]:
    """What opens scenes of a kind; perception is imported only if it is needed."""
    match kind:
        case "drawn":
            from kille.lab.scenes.drawn import draw_scene

            return draw_scene
        case "around":
            from kille.lab.scenes.around_landmark import open_around

            return open_around
        case "statements":
            from kille.lab.scenes.statements import open_statements

            return open_statements
        case "rendered":
            from kille.lab.scenes.rendered import open_rendered

            return open_rendered
    from kille.lab.scenes.captured import open_captures, open_pictures

    return {"pictures": open_pictures, "captures": open_captures}[kind]


# --- what is wrong with a scene -------------------------------------------------------


def faults(named: Named, study: Study) -> Iterator[Problem]:
    """What is wrong with a scene in this study: its data are not there, or too few.

    >>> from pathlib import Path
    >>> from kille.lab.study_files import parse
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "teach"
    ... '''
    >>> cups = parse(text, Path("cups.toml"))
    >>> [*faults(cups.scenes["table"], cups)]
    []
    """
    if named.kind not in SETTINGS:
        return
    wrong = [*_setting_problems(named), *_folder_problems(named, study)]
    yield from wrong
    if wrong:
        return
    try:
        scene = open_scene(study, Run("", "", named.name, 0))
        yield from _empty_phases(scene, named, study)
    except (ExperimentError, SensorError) as error:
        yield Problem((), str(error))
    except StudyError as error:
        yield from (Problem((), it) for it in error.faults)


def _setting_problems(named: Named) -> Iterator[Problem]:
    """What is wrong with the settings of a scene."""
    if named.kind == "rendered":
        yield from _rendering_problems(named)
    set_ = fill_settings(named.settings, SETTINGS[named.kind])
    if "target" in set_ and set_["target"] == set_["landmark"]:
        told = f"both target and landmark are the {set_['target']}: name two kinds"
        key = "target" if "target" in named.settings else "landmark"
        yield Problem((key,), told)
    for key in ("kinds", "hues", "rings"):
        if named.kind in ("drawn", "around") and key in set_ and not set_[key]:
            told = f"{key} of {named.name} is empty: name some, or leave it out"
            yield Problem((key,), told)


def _folder_problems(named: Named, study: Study) -> Iterator[Problem]:
    folder = named.settings.get("folder")
    if folder is None:
        return
    if told := why_no_folder(study.path(folder)):
        yield Problem(("folder",), told)


def _empty_phases(scene: Scene, named: Named, study: Study) -> Iterator[Problem]:
    """Phases that are of what is new, where nothing is kept for later."""
    for phase in study.phases:
        if phase.settings.get("of") != "new":
            continue
        kind = WORDS[phase.settings.get("what", "nouns")]
        if not scene.round(kind, True, Random(0)):
            told = f"nothing is kept in {named.name} for the phase {phase.name}, which"
            told = f"{told} is of what is new: {_how_to_keep(named)}"
            yield Problem(("new",), told)


def _how_to_keep(named: Named) -> str:
    """The hint by which something is kept for later."""
    set_ = fill_settings(named.settings, SETTINGS[named.kind])
    if named.kind == "captures":
        return "name the scenes that are, new = […]"
    if named.kind in ("pictures", "statements") and set_["new"]:
        return "write a smaller each"
    return f"write new = {set_['new'] + 1}"


def _rendering_problems(named: Named) -> Iterator[Problem]:
    """The things and faults of a scene that cannot be rendered."""
    from kille.sensors.synthetic import open_synthetic
    from kille.sensors.synthetic.catalogue import TOY_NAMES

    set_ = fill_settings(named.settings, SETTINGS["rendered"])
    things = [("kinds", name) for name in set_["kinds"]]
    things += [(key, set_[key]) for key in ("target", "landmark")]
    for key, name in things:
        if name not in TOY_NAMES:
            told = f"there is no {name} to be rendered: {suggest_name(name, TOY_NAMES)}"
            yield Problem((key,), told)
    try:
        open_synthetic(f"synthetic:empty?faults={quote(set_['faults'])}").close()
    except SensorError as error:
        yield Problem(("faults",), str(error))
