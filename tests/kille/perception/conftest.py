"""Lets the tests of this folder import the scenes they share (`tabletop`)."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent))
