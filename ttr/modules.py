"""Python files of a user's own, run as modules that may import what is beside them."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

__all__ = ["importing_from", "run_file"]


def run_file(file: Path, name: str) -> ModuleType:
    """The module of a file, under this name, by running it.

    Raises ImportError for what is no Python file, and whatever the file raises.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "answer.py")
    ...     _ = file.write_text("value = 42")
    ...     run_file(file, "_an_answer").value
    42
    """
    spec = importlib.util.spec_from_file_location(name, file)
    if spec is None or spec.loader is None:
        raise ImportError(f"{file} is no Python file")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # where dataclasses look their module up
    with importing_from(file.resolve().parent):
        spec.loader.exec_module(module)
    return module


@contextmanager
def importing_from(folder: Path) -> Iterator[None]:
    """Lets a file import what lies in a folder, as when Python runs it there."""
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
