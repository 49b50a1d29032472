"""Studies as files: read to values, and checked before anything is played."""

from kille.lab.study_files.checking import check, checked
from kille.lab.study_files.file import parsed, read

__all__ = ["check", "checked", "parsed", "read"]
