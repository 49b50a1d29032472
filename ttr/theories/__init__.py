"""Theories: all that a `.ttr` file declares, defines, assumes and claims.

Read `theory` first, then `loading` and `statements` (how a file is read; they are
loaded only where one is), `queries` and `checking` (what it claims, and whether that
holds). May import: updates, notation, judging and what these may import.
"""

from ttr.theories.theory import Theory, load

__all__ = ["Theory", "load"]
