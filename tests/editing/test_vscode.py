"""The extension for Visual Studio Code, played by Node where there is one."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from ttr.cli.main import main

HOST = Path(__file__).with_name("vscode_host.js")
PATIENCE = 60  # seconds


@pytest.fixture
def extension(tmp_path: Path) -> Path:
    assert main(["editor", "vscode", str(tmp_path / "ttr.vsix")]) == 0
    with zipfile.ZipFile(tmp_path / "ttr.vsix") as archive:
        archive.extractall(tmp_path / "unpacked")
    return tmp_path / "unpacked"


def test_all_that_the_package_names_is_in_it(extension: Path) -> None:
    about = json.loads((extension / "extension/package.json").read_text())
    named = [about["main"]]
    named += [it["configuration"] for it in about["contributes"]["languages"]]
    named += [it["path"] for it in about["contributes"]["grammars"]]
    assert [it for it in named if not (extension / "extension" / it).is_file()] == []
    manifest = ElementTree.parse(extension / "extension.vsixmanifest").getroot()
    identity = manifest.find(".//{*}Identity")
    assert identity is not None
    assert identity.get("Version") == about["version"]
    types = ElementTree.parse(extension / "[Content_Types].xml").getroot()
    suffixes = {it.get("Extension") for it in types}
    inside = {it.suffix for it in (extension / "extension").iterdir()}
    assert inside <= suffixes


def played(extension: Path, command: str, *words: object) -> Any:
    node = shutil.which("node")
    if node is None:
        pytest.skip("needs Node (apt install nodejs)")
    done = subprocess.run(
        [node, HOST, extension / "extension", command, *map(str, words)],
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert done.stderr == ""
    return json.loads(done.stdout)


@pytest.fixture
def command(tmp_path: Path) -> str:
    file = tmp_path / "ttr"
    file.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m ttr.cli.main "$@"\n')
    file.chmod(0o755)
    return str(file)


@pytest.mark.deep
def test_the_extension_shows_what_the_server_says(
    extension: Path, command: str, tmp_path: Path
) -> None:
    (tmp_path / "a.ttr").write_text("basic Ind\nDog := [x : Ind, y : Idn]\n")
    found = played(extension, command, tmp_path / "a.ttr", 0, 7)
    ((mistake,),) = found["told"]
    assert mistake["message"].startswith("nothing is called Idn here")
    assert (mistake["severity"], mistake["range"]["line"]) == (0, 1)
    assert found["hover"]["contents"]["value"] == "```ttr\nbasic Ind\n```"
    assert found["definition"][0]["range"]["character"] == 6
    assert {"Ind", "Dog", "list"} <= {it["label"] for it in found["completion"]}
    assert [it["name"] for it in found["symbols"]] == ["Ind", "Dog"]


def test_a_missing_server_is_one_warning(extension: Path, tmp_path: Path) -> None:
    (tmp_path / "a.ttr").write_text("basic Ind\n")
    found = played(extension, str(tmp_path / "none"), tmp_path / "a.ttr", 0, 7)
    (warning,) = found["told"]
    assert "cannot be started (ENOENT)" in warning
    assert found["hover"] is None
