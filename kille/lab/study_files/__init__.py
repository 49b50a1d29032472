"""Studies as files: read to values, and checked before anything is played."""

from kille.lab.study_files.checking import check, read_and_check
from kille.lab.study_files.file import parse, read
from ttr.aliases import former_names

__all__ = ["check", "read_and_check", "parse", "read"]

__getattr__ = former_names(__name__, {"checked": "read_and_check", "parsed": "parse"})
