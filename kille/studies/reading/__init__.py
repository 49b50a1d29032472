"""Studies as files: read to values, and checked before anything is played."""

from kille.studies.reading.checking import check, checked
from kille.studies.reading.consenting import check_allowed, python_in, unallowed
from kille.studies.reading.file import parsed, read

__all__ = [
    "check",
    "check_allowed",
    "checked",
    "parsed",
    "python_in",
    "read",
    "unallowed",
]
