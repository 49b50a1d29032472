"""Stories: dialogues as tests that anyone can write, in files `.dlg`.

`read_stories` reads them, `setting` finds the game that they name, and `play` plays
them and says where they differ from what happens. `written` makes a story of turns.
"""

from ttr.stories.hearing import Alternative, alternatives
from ttr.stories.mismatches import SILENCE, Mismatch
from ttr.stories.opening import opening, setting_of
from ttr.stories.outcomes import Outcome, facts, junit, summary
from ttr.stories.playing import Played, failing, fits, play
from ttr.stories.reading import Line, Story, StoryError, read_stories
from ttr.stories.settings import Setting, setting
from ttr.stories.writing import Moment, moment, worded, written

__all__ = [
    "SILENCE",
    "Alternative",
    "Line",
    "Mismatch",
    "Moment",
    "Outcome",
    "Played",
    "Setting",
    "Story",
    "StoryError",
    "alternatives",
    "facts",
    "failing",
    "fits",
    "junit",
    "moment",
    "opening",
    "play",
    "read_stories",
    "setting",
    "setting_of",
    "summary",
    "worded",
    "written",
]
