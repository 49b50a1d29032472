"""Lets the tests of mutants import the games that they are made of."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent))
