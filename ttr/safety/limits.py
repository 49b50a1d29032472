"""Limits on the size of inputs that somebody else may have written.

All limits of `ttr` and `kille` stand here. They are far above what people write,
record or measure, and low enough that whatever is within them is read in seconds and in
500 MB of memory. If you need more, set `KILLE_LIMITS` in the environment: with
`KILLE_LIMITS=4`, four times as much of everything is read, and every wait may be four
times as long.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from errno import EFBIG

FACTOR = "KILLE_LIMITS"
"""The environment variable that multiplies all limits."""


class InputLimitError(OSError):
    """An input that is over a limit: one line says by how much."""

    def __init__(self, why: str) -> None:
        super().__init__(EFBIG, why)


@dataclass(frozen=True)
class Limit:
    """The largest input of one kind that is read, in some unit.

    >>> Limit(1_000, "pixels").check(999)
    >>> Limit(1_000, "pixels").too_much(3_500).strerror
    'it has 3,500 pixels, and no more than ...'
    """

    most: int
    unit: str

    @property
    def maximum(self) -> int:
        """The limit, as the environment multiplies it now."""
        return math.ceil(self.most * _factor())

    def check(self, found: int) -> None:
        """Raises `InputLimitError` where more was found than is allowed."""
        if found > self.maximum:
            raise self.too_much(found)

    def too_much(self, found: int | None = None) -> InputLimitError:
        """The error that an input is over the limit, with the way to have it read.

        Without `found`, it is not known how much there is, as with a pipe.
        """
        most = amount(self.maximum, self.unit)
        if found is None:
            return InputLimitError(
                f"it has more than {most} ({FACTOR}=10 reads ten times that)"
            )
        return InputLimitError(
            f"it has {amount(found, self.unit)}, and no more than {most} are read "
            f"({FACTOR}={math.ceil(found / self.most)} reads it all the same)"
        )


_PREFIXES = ((10**12, "TB"), (10**9, "GB"), (10**6, "MB"), (10**3, "kB"))


def amount(number: int, unit: str) -> str:
    """A number of units, as people say it.

    >>> amount(3_221_225_472, "bytes"), amount(900_000_000, "pixels")
    ('3.22 GB', '900,000,000 pixels')
    """
    if unit == "bytes":
        for size, prefix in _PREFIXES:
            if number >= size:
                return f"{number / size:.3g} {prefix}"
    return f"{number:,} {unit}"


def _factor() -> float:
    """By what the environment multiplies the limits; 1 by default."""
    try:
        told = float(os.environ.get(FACTOR, "1"))
    except ValueError:
        return 1.0
    return told if 0 < told <= 1e6 else 1.0


# --- texts ---------------------------------------------------------------------------

THEORY = Limit(500_000, "bytes")
"""A file of a theory (`.ttr`), about 10,000 lines."""

STORIES = Limit(4_000_000, "bytes")
"""A file of dialogues (`.dlg`), about 100,000 lines."""

LOG = Limit(100_000_000, "bytes")
"""A log of dialogues (`.jsonl`)."""

LINE = Limit(1_000_000, "characters")
"""A line of a log, of a package, or of what is typed or piped in."""

UTTERANCE = Limit(10_000, "characters")
"""What is said to the robot at once."""

SETTINGS = Limit(250_000, "bytes")
"""A file of settings: a study, a lexicon, a grammar, a calibration."""

PROBLEMS = Limit(2_000_000, "bytes")
"""A set of FraCaS problems (XML); the whole of it has 140,000 bytes."""

TABLE = Limit(20_000_000, "bytes")
"""A table of people's judgements (CSV), or a description of captures (JSON)."""

# --- waiting -------------------------------------------------------------------------

SILENCE = Limit(10, "seconds")
"""How long a pipe may be silent before it is given up."""

PIPE = Limit(60, "seconds")
"""How long a pipe may take to say all it says."""

# --- pictures, arrays and sounds -----------------------------------------------------

PICTURE_FILE = Limit(100_000_000, "bytes")
"""A file of one picture."""

PICTURE = Limit(50_000_000, "pixels")
"""A picture in colour."""

MEASURED = Limit(12_000_000, "pixels")
"""A picture of depth or labels, whose pixels may have 32 bytes each."""

ARRAYS = Limit(250_000_000, "bytes")
"""The arrays of one archive (`.npz`) together, as far as they are held in memory."""

SOUND_FILE = Limit(120_000_000, "bytes")
"""A file of sound (WAV)."""

SOUND = Limit(30 * 60, "seconds")
"""A sound."""

MESH = Limit(20_000_000, "bytes")
"""A mesh (OBJ), or its materials."""

MESSAGE = Limit(150_000_000, "bytes")
"""A message of a bag, or a chunk of them as it is when it is decompressed."""

BAG_UNPACKED = Limit(4_000_000_000, "bytes")
"""A file of a bag that is compressed as a whole, when it is unpacked."""

FRAMES = Limit(1_000_000, "frames")
"""The frames of a recording, nine hours of a Kinect's."""

# --- archives ------------------------------------------------------------------------

DIRECTORY = Limit(16_000_000, "bytes")
"""The list at the end of a zip of what is in it, about 200,000 files."""

MEMBER = Limit(64_000_000, "bytes")
"""A file of an exported memory: a picture, a lesson's features, or a list."""

PACKAGE = Limit(4_000_000_000, "bytes")
"""All files of an exported memory together."""
