"""Studies as files: read to values, and checked before anything is played."""

from kille.studies.reading.checking import check, checked
from kille.studies.reading.file import parsed, read

__all__ = ["check", "checked", "parsed", "read"]
