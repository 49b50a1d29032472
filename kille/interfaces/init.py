"""`kille init`: a folder with what the robot says and understands, to be edited."""

from __future__ import annotations

import re
import shlex
from importlib.resources import files
from pathlib import Path

from kille.dialogue.language_files import FILES, STRATEGIES
from kille.dialogue.theory_files import SOURCE
from kille.interfaces.terminal import FAILED, FINE, complain, console
from ttr.safety.files import why_unwritten

_LEARNED = re.compile(r"^learned = .*$", re.MULTILINE)
"""The wording that is changed first: what the robot says to a lesson."""

_TRY = """\
{folder} has {types}: what things mean, {grammar}: what you may say,
{lexicon}: what the robot says, and {strategies}: what it decides by.

Try first, in {folder}/{lexicon}, another wording for
  {learned}
and talk to it:
  kille talk --theory {quoted}{language}
  U> @ show cup
  U> {lesson}

Mistakes are told before it talks. For more to try, see "Change what it says" in the
documentation, or kille talk --help.
"""

_LESSONS = {"en": "This is a cup.", "sv": "Det här är en kopp."}


def init(folder: Path, language: str) -> int:
    """Copies the files of a language, the types and the strategies; the exit code.

    The folder must be new, or empty.
    """
    grammar, lexicon = (name.format(language) for name in FILES)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.iterdir()):
            return complain(f"{folder} is not empty: name a new folder")
        for name in (SOURCE, grammar, lexicon, STRATEGIES):
            text = files("kille.grammars").joinpath(name).read_bytes()
            (folder / name).write_bytes(text)
    except FileExistsError:
        return complain(f"{folder} is a file: name a new folder")
    except OSError as error:
        return complain(why_unwritten(folder, error), FAILED)
    learned = _LEARNED.search((folder / lexicon).read_text(encoding="utf-8"))
    assert learned is not None
    told = _TRY.format(
        folder=folder,
        types=SOURCE,
        grammar=grammar,
        lexicon=lexicon,
        strategies=STRATEGIES,
        learned=learned[0],
        quoted=shlex.quote(str(folder)),
        language="" if language == "en" else f" --lang {language}",
        lesson=_LESSONS[language],
    )
    console().print(told.rstrip(), markup=False, soft_wrap=True)
    return FINE
