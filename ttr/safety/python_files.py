"""Run the user's own Python files, which may import what lies beside them."""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

from ttr.safety.consent import Consent, is_below


def run_named(
    python: str, folder: Path, prefix: str, consent: Consent | None
) -> ModuleType:
    """The module that FILE.py, relative to a folder, or MODULE names; runs a file anew.

    Without a `consent`, it is the caller who names it. Raises `NotAllowedError` where
    there is no consent, and whatever running it raises.
    """
    if consent is None:
        consent = Consent.of([folder]).with_python(python, folder)
    consent.check_python(python, folder)
    if python.endswith(".py"):
        file = folder / python
        return run_file(file, f"{prefix}{file.stem}")
    beside = consent.folder_of(python)
    if beside is None:
        return importlib.import_module(python)
    with _imports_from(beside):
        module = importlib.import_module(python)
    found = getattr(module, "__file__", None)
    if found is None or not is_below(found, beside):
        raise ImportError(f"another module is called {python}: rename that in {beside}")
    return module


def separate_python(*arguments: str) -> tuple[list[str], dict[str, str]]:
    """The command and environment of another process that runs Python as this one does.

    It imports from where this process imports, and not from the working directory:
    what lies there by chance must not be run.
    """
    modules = os.pathsep.join(filter(None, map(str, sys.path)))
    return [sys.executable, "-P", *arguments], {**os.environ, "PYTHONPATH": modules}


def run_file(file: Path, name: str) -> ModuleType:
    """Runs a file as a module of this name, and gives the module.

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
    with _imports_from(file.resolve().parent):
        spec.loader.exec_module(module)
    return module


@contextmanager
def _imports_from(folder: Path) -> Iterator[None]:
    """Lets a file import from a folder, as when Python runs it there."""
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
