"""The durable memory: what was said, seen and learned, kept in one SQLite file.

What the robot was taught is on disk before it says "OK", with its evidence: the turn,
the sensor's scans, traits, places and pictures. Models are rebuilt from these.
"""

from kille.memory.errors import MemoryFileError, NoSuchLessonError
from kille.memory.files import default_path
from kille.memory.lessons import (
    Arrangement,
    Criterion,
    CriterionLesson,
    Dialogue,
    Kind,
    KindLesson,
    Lesson,
    ObjectLesson,
    RelationLesson,
    Scan,
    Sighting,
    Subsumption,
    Turn,
    Word,
)
from kille.memory.memory import Memory, MemoryReader
from kille.memory.pictures import Crop, Picture

__all__ = [
    "Memory",
    "MemoryReader",
    "default_path",
    "Word",
    "Kind",
    "Dialogue",
    "Turn",
    "Scan",
    "Sighting",
    "Arrangement",
    "Subsumption",
    "Criterion",
    "Picture",
    "Crop",
    "Lesson",
    "ObjectLesson",
    "RelationLesson",
    "KindLesson",
    "CriterionLesson",
    "MemoryFileError",
    "NoSuchLessonError",
]
