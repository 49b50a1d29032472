"""Lets the tests of this folder import the scenes that tests of perception share."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[1]))
