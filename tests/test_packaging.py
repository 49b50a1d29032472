"""What is installed is all that was written: from the wheel, and from the source."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import sysconfig
import tomllib
import venv
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
SETTINGS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
SETUP = SETTINGS["tool"]["setuptools"]
FOLDERS = {name: SETUP["package-dir"].get(name) for name in SETUP["packages"]}

LOOK = """
import importlib, importlib.resources, json, sys
def sizes(folder, where=""):
    found = {}
    for it in folder.iterdir():
        if it.is_file():
            found[where + it.name] = len(it.read_bytes())
        elif it.name != "__pycache__" and not (it / "__init__.py").is_file():
            found |= sizes(it, f"{where}{it.name}/")
    return found
found = {}
for name in sys.argv[1:]:
    found[name] = sizes(importlib.resources.files(name))
    importlib.import_module(name)
print(json.dumps([found, importlib.import_module("kille").__file__]))
"""


def folder_of(package: str) -> Path:
    """Where the source of a package is."""
    return Path(FOLDERS[package] or package.replace(".", "/"))


def written(source: Path) -> dict[str, dict[str, int]]:
    """The files of each package as they were written, with their sizes."""
    return {package: sizes(source / folder_of(package)) for package in FOLDERS}


def sizes(folder: Path) -> dict[str, int]:
    """The bytes of each file in a folder, and below it where there is only data."""
    found = {}
    for it in folder.iterdir():
        if it.is_file():
            found[it.name] = it.stat().st_size
        elif not (it / "__init__.py").is_file():
            inner = {} if it.name == "__pycache__" else sizes(it)
            found |= {f"{it.name}/{name}": size for name, size in inner.items()}
    return found


def pip(*arguments: str | Path) -> None:
    """Run pip without any registry: all it needs is in the environment of the tests."""
    run = subprocess.run(
        [sys.executable, "-m", "pip", *map(str, arguments)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stdout + run.stderr


def install(environment: Path, *what: str | Path) -> Path:
    """The Python of a new environment with this installed.

    The dependencies are those of the environment of the tests, whose own `.pth` files,
    and with them the source tree, do not count here.
    """
    venv.create(environment, symlinks=True)
    python = environment / "bin" / "python"
    here = sysconfig.get_path("purelib", vars={"base": str(environment)})
    Path(here, "dependencies.pth").write_text(sysconfig.get_path("purelib") + "\n")
    pip("--python", python, "install", "-q", "--no-deps", "--no-index", *what)
    return python


def look(python: Path) -> tuple[dict[str, dict[str, int]], Path]:
    """The files of each package as this Python finds them, and where `kille` is."""
    run = subprocess.run(
        [python, "-I", "-c", LOOK, *SETUP["packages"]],
        cwd=python.parent,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    found, kille = json.loads(run.stdout)
    return found, Path(kille)


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of what the distribution is made of, and of nothing else."""
    copy = tmp_path_factory.mktemp("source")
    caches = shutil.ignore_patterns("__pycache__", "*.egg-info")
    for folder in ("ttr", "kille", "grammars"):
        shutil.copytree(ROOT / folder, copy / folder, ignore=caches)
    for file in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / file, copy)
    return copy


@pytest.fixture(scope="module")
def wheel(source: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    pip("wheel", "-q", "--no-deps", "--no-build-isolation", "-w", folder, source)
    (built,) = folder.glob("kille-*.whl")
    return built


@pytest.mark.package
def test_the_wheel_has_every_file_and_works_away_from_the_source(
    source: Path, wheel: Path, tmp_path: Path
) -> None:
    found, kille = look(install(tmp_path / "environment", wheel))
    assert kille.is_relative_to(tmp_path)
    assert found == written(source)


@pytest.mark.package
def test_the_editable_install_has_every_file(source: Path, tmp_path: Path) -> None:
    found, kille = look(
        install(tmp_path / "environment", "--no-build-isolation", "-e", source)
    )
    assert kille.is_relative_to(source)
    assert found == written(source)


@pytest.mark.package
def test_the_wheel_holds_the_packages_and_nothing_else(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        folders = {name.partition("/")[0] for name in archive.namelist()}
    assert folders == {
        "ttr",
        "kille",
        f"kille-{SETTINGS['project']['version']}.dist-info",
    }


def test_every_folder_with_code_is_a_package_that_is_listed() -> None:
    with_code = {
        str(file.parent.relative_to(ROOT))
        for folder in ("ttr", "kille", "grammars")
        for file in (ROOT / folder).rglob("*.py")
    }
    assert with_code == {str(folder_of(package)) for package in FOLDERS}
    for folder in with_code:
        assert (ROOT / folder / "__init__.py").is_file()
