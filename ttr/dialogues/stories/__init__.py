"""Stories: dialogues as tests that anyone can write, in files `.dlg`.

`read_stories` reads them, `setting` finds the game that they name, and `play` plays
them and says where they differ from what happens. `written` makes a story of turns.
"""

from typing import TYPE_CHECKING

from ttr.aliases import former_names
from ttr.dialogues.event_wording import wording
from ttr.dialogues.settings import (
    Setting,
    StoryError,
    named_by_user,
    python_in,
    setting,
)
from ttr.dialogues.stories.junit_report import Outcome, facts, junit, summary
from ttr.dialogues.stories.line_events import Alternative, alternatives
from ttr.dialogues.stories.mismatches import SILENCE, Mismatch
from ttr.dialogues.stories.story_opening import check_consent, opening, setting_of
from ttr.dialogues.stories.story_player import Played, failure_reason, fits, play
from ttr.dialogues.stories.story_reader import Line, Story, read_stories
from ttr.dialogues.stories.story_writer import format_story, story_text

__all__ = [
    "SILENCE",
    "Alternative",
    "Line",
    "Mismatch",
    "Outcome",
    "Played",
    "Setting",
    "Story",
    "StoryError",
    "alternatives",
    "check_consent",
    "facts",
    "failure_reason",
    "fits",
    "format_story",
    "junit",
    "named_by_user",
    "opening",
    "play",
    "python_in",
    "read_stories",
    "setting",
    "setting_of",
    "story_text",
    "summary",
    "wording",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)
