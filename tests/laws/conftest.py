"""Lets the laws import the types, records and models they share (`generators`)."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent))
