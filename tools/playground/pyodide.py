"""What the page needs from npm and PyPI: fetched once, its checksum pinned, cached."""

from __future__ import annotations

import base64
import hashlib
import io
import os
import shutil
import subprocess
import sys
import tarfile
import urllib.request
from pathlib import Path

from platformdirs import user_cache_path

VERSION = "314.0.7"
SHA512 = (
    "0YvXxEhfEdpLfb/XkM2BFAeMROq0iMUX2bzzH9pOttyMcWkwq+HbE5uyuGD82LN7y2q+SNvi/"
    "6V5JEsOlD2R1A=="
)
"""The checksum of the package, as npm's `integrity` has it."""

FILES = (
    "pyodide.mjs",
    "pyodide.asm.mjs",
    "pyodide.asm.wasm",
    "python_stdlib.zip",
    "pyodide-lock.json",
)
WHEELS = {
    "hypothesis-6.155.7-py3-none-any.whl": (
        "9f634bdb1f9e9b8ab6ba09431cf2deedb750c96978125a6fb3c5a0f6c6db4131"
    ),
    "sortedcontainers-2.4.0-py2.py3-none-any.whl": (
        "a163dcaede0f1c021485e957a39245190e74249897e2ae4b2aa38595db237ee0"
    ),
}
"""Libraries in Python alone, by their SHA-256; later Hypotheses need parts in Rust."""

SECONDS = 60


class FetchError(Exception):
    """The package cannot be had; says why in one line."""


def pyodide_files() -> dict[str, bytes]:
    """The files of Pyodide that a page needs; raises `FetchError`."""
    with tarfile.open(fileobj=io.BytesIO(_package()), mode="r:gz") as packed:
        found = {}
        for name in FILES:
            file = packed.extractfile(f"package/{name}")
            assert file is not None
            found[name] = file.read()
    return found


def wheels() -> tuple[bytes, ...]:
    """The libraries that property tests need there; raises `FetchError`."""
    return tuple(_wheel(name, checksum) for name, checksum in WHEELS.items())


def _wheel(name: str, checksum: str) -> bytes:
    cached = user_cache_path("kille") / name
    if not (cached.is_file() and _has_checksum(cached, checksum)):
        library, version, *_ = name.split("-")
        options = ["--no-deps", "--only-binary=:all:", "--platform", "any"]
        options += ["--python-version", "3.14", "--implementation", "py"]
        options += ["--abi", "none", "--dest", str(cached.parent)]
        command = [sys.executable, "-m", "pip", "download", "--quiet", *options]
        done = subprocess.run(
            [*command, f"{library}=={version}"], capture_output=True, check=False
        )
        if done.returncode or not _has_checksum(cached, checksum):
            raise FetchError(f"{library} {version} cannot be fetched from PyPI by pip")
    return cached.read_bytes()


def _has_checksum(file: Path, checksum: str) -> bool:
    return hashlib.sha256(file.read_bytes()).hexdigest() == checksum


def _package() -> bytes:
    cached = user_cache_path("kille") / f"pyodide-{VERSION}.tgz"
    if cached.is_file() and _is_right(kept := cached.read_bytes()):
        return kept
    fetched = _fetch(f"{_registry()}/pyodide/-/pyodide-{VERSION}.tgz")
    if not _is_right(fetched):
        raise FetchError(f"pyodide {VERSION} from npm has not the checksum expected")
    cached.parent.mkdir(parents=True, exist_ok=True)
    partial = cached.with_suffix(f".{os.getpid()}")
    partial.write_bytes(fetched)
    partial.replace(cached)
    return fetched


def _is_right(package: bytes) -> bool:
    digest = hashlib.sha512(package).digest()
    return base64.b64encode(digest).decode() == SHA512


def _fetch(address: str) -> bytes:
    try:
        with urllib.request.urlopen(address, timeout=SECONDS) as answer:
            found: bytes = answer.read()
    except OSError as error:
        raise FetchError(
            f"pyodide {VERSION} cannot be fetched from npm ({error}): try again with a "
            "network, or set npm_config_registry"
        ) from None
    return found


def _registry() -> str:
    """The registry that npm is set to here, else the public one."""
    set_to = os.environ.get("npm_config_registry", "")  # noqa: SIM112 - npm has it so
    npm = shutil.which("npm")
    if not set_to and npm:
        told = subprocess.run(
            [npm, "config", "get", "registry"],
            capture_output=True,
            text=True,
            check=False,
        )
        set_to = told.stdout.strip()
    known = set_to.startswith(("https://", "http://"))
    return (set_to if known else "https://registry.npmjs.org").rstrip("/")
