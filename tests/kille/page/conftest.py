"""The page's tests need what the page needs."""

from __future__ import annotations

from importlib.util import find_spec

if all(map(find_spec, ("starlette", "uvicorn", "websockets", "cryptography"))):
    from .pages import page, start

    __all__ = ["page", "start"]
else:
    collect_ignore_glob = ["test_*.py"]
