"""What may be set of tutors, kind by kind."""

from __future__ import annotations

from collections.abc import Mapping

from kille.lab.settings import Setting, Settings
from kille.lab.tutors.simulated import FEEDBACK

_SIMULATED: Settings = {
    "calls": Setting(dict, {}, about='what he calls something else: {mug = "cup"}'),
    "vocabulary": Setting(str, (), several=True, about="the only words he has"),
    "errors": Setting(float, 0.0, most=1.0, about="the share of wrong lessons"),
    "feedback": Setting(str, "both", among=FEEDBACK),
    "patience": Setting(int, 3, about="questions that he answers in a row"),
    "politeness": Setting(float, 0.0, most=1.0, about="how often he says thank you"),
    "frame": Setting(
        (str, float),
        "viewer",
        among=("viewer", "landmark"),
        most=1.0,
        about="in whose frame he speaks, or how often in the landmark's own",
    ),
    "orients": Setting(bool, False, about="whether he says which way landmarks face"),
    "places": Setting(str, "likeliest", among=("likeliest", "drawn")),
    "inside": Setting(float, 0.45, most=1.0, about="how often he says near when it is"),
    "outside": Setting(
        float, 0.10, most=1.0, about="how often he says near farther off"
    ),
    "habit": Setting(
        float, 0.0, most=10.0, about="how people differ in that, in log-odds"
    ),
}

SETTINGS: Mapping[str, Settings] = {
    "simulated": _SIMULATED,
    "people": {
        **_SIMULATED,
        "folder": Setting(
            str, needed=True, about="people's ratings of places on a grid"
        ),
    },
    "scripted": {"file": Setting(str, needed=True, about="a dialogue, NAME.dlg")},
    "keyboard": {},
    "own": {
        "make": Setting(str, needed=True, about="FILE.py:NAME or MODULE:NAME"),
        "settings": Setting(dict, {}, about="what NAME is called with, by name"),
    },
    "several": {
        "of": Setting(
            str,
            needed=True,
            several=True,
            twice=True,
            about="the names of the tutors; who is there twice has two turns",
        ),
        "turns": Setting(str, "phase", among=("phase", "task")),
    },
}
"""What may be set of tutors, kind by kind."""
