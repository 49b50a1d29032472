"""The documents are true: links lead somewhere, what is shown is what happens.

Python in the pages runs as doctests. Here the rest is rehearsed, page by page, in a
folder of its own with a copy of the program. A block `diff FILE` is a change of a file
of the copy, a block `dlg` is replayed, a block `console` is typed line by line and must
answer as shown, and any other block with the name of a file is that file.
"""

from __future__ import annotations

import argparse
import ast
import doctest
import importlib
import inspect
import os
import pkgutil
import re
import runpy
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path
from typing import NamedTuple

import pytest

import kille
import ttr
from kille import Agent, Memory
from kille.sensors.sources import open_sensor
from ttr.aliases import Alias
from ttr.semantics.learning import Counts, LogOdds
from ttr.semantics.modality import modal_system
from ttr.semantics.random_variables import RandomVariable

ROOT = Path(__file__).resolve().parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
SAME = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
PROGRAMS = {"kille": "kille.interfaces.cli", "ttr": "ttr.cli.main"}
RUNS = PROGRAMS | {"pytest": "pytest"}


def named(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


# --- what is played ------------------------------------------------------------------


def test_the_games_are_shown_as_they_are_played() -> None:
    script = ROOT / "docs" / "pictures" / "games.py"
    played: str = runpy.run_path(str(script))["page"]()
    shown = (ROOT / "docs" / "reference" / "games.md").read_text("utf-8")
    assert played == shown, "run `python docs/pictures/games.py`"


# --- links ---------------------------------------------------------------------------


def links(page: Path) -> list[str]:
    """The targets of links and pictures, outside of code."""
    text = re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.M | re.S)
    return re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", text))


def anchors(page: Path) -> set[str]:
    """What a link into the page can name: its headings, as web pages write them."""
    text = re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.M | re.S)
    headings = re.findall(r"^#+ +(.+)$", text, flags=re.M)
    return {
        re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")
        for heading in headings
    }


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_relative_links_lead_to_files_and_headings(page: Path) -> None:
    lost = []
    for link in links(page):
        path, _, anchor = link.partition("#")
        if "://" in link:
            continue
        target = page.parent / path if path else page
        if not target.exists() or (anchor and anchor not in anchors(target)):
            lost.append(link)
    assert not lost


def test_every_page_can_be_reached_from_the_index() -> None:
    reached, waiting = set[Path](), [ROOT / "docs" / "index.md"]
    while waiting:
        page = waiting.pop()
        if page.suffix != ".md" or page in reached:
            continue
        reached.add(page)
        local = (link.partition("#")[0] for link in links(page) if "://" not in link)
        waiting += [(page.parent / path).resolve() for path in local if path]
    assert not set(PAGES) - reached - {ROOT / "README.md"}


def test_pictures_are_small() -> None:
    pictures = list((ROOT / "docs" / "pictures").glob("*.png"))
    assert pictures
    assert max(picture.stat().st_size for picture in pictures) < 300_000


# --- definitions ----------------------------------------------------------------------

DEFINITIONS = ROOT / "docs" / "explanation" / "which-definitions.md"


def definitions() -> dict[str, str]:
    """The definitions of the page, as they are stated, each with what is said of it."""
    text = DEFINITIONS.read_text("utf-8")
    return {
        item.partition("\n")[0]: re.split(r"\n\n", item.partition("\n")[2])[0]
        for item in re.split(r"^- (?=\*\*)", text, flags=re.M)[1:]
    }


def names_defined(file: Path) -> set[str]:
    """What a file defines: in Python also the methods of its classes, `Class.method`;
    in a theory its definitions."""
    text = file.read_text("utf-8")
    if file.suffix == ".ttr":
        return set(re.findall(r"^(\w+) +:=", text, flags=re.M))
    return set(names_bound(ast.parse(text).body))


def names_bound(body: list[ast.stmt]) -> Iterator[str]:
    for statement in body:
        match statement:
            case ast.FunctionDef(name=name):
                yield name
            case ast.ClassDef(name=name, body=inner):
                yield name
                yield from (f"{name}.{it}" for it in names_bound(inner))
            case ast.Assign(targets=[ast.Name(id=name)]):
                yield name
            case ast.AnnAssign(target=ast.Name(id=name)):
                yield name


def linked_names(said: str, how: str) -> list[tuple[str, str, Path]]:
    """The links of the line that begins so: what they are called, the name in it, and
    the file."""
    line = "".join(re.findall(rf"^  - {how} (.*)", said, flags=re.M))
    found = re.findall(r"\[`([^`]+)`\]\(([^)\s]+)\)", line)
    return [
        (called, name_in(called, path), (DEFINITIONS.parent / path).resolve())
        for called, path in found
    ]


def name_in(called: str, path: str) -> str:
    """The name within a file: of `ttr.types.syntax.Pred`, `Pred`; of `FILE::test`, the
    test."""
    if "::" in called:
        return called.partition("::")[2]
    module = path.removeprefix("../../").removesuffix(".py").removesuffix("/__init__")
    return called.removeprefix(module.replace("/", ".") + ".")


def test_definitions_are_where_the_page_says_and_tested() -> None:
    found = definitions()
    assert found
    for what, said in found.items():
        coded, tested = linked_names(said, "in"), linked_names(said, "tested by")
        assert coded, f"{what} has no code"
        assert tested, f"{what} has no test"
        for called, name, file in coded + tested:
            assert name in names_defined(file), f"There is no {called}, of {what}"
        for called, name, file in tested:
            assert called == f"{file.relative_to(ROOT).as_posix()}::{name}", what
            assert name.startswith("test_"), what


# --- what pages show -----------------------------------------------------------------


class Block(NamedTuple):
    """A fenced block: its language, the file it is or "", its text."""

    language: str
    file: str
    text: str


class Command(NamedTuple):
    """A command with what is typed into it, and what page shows of its answer."""

    line: str
    typed: str
    shown: str


def blocks(page: Path) -> list[Block]:
    found = re.findall(
        r"^```(\w+) ?(\S*)\n(.*?)^```", page.read_text("utf-8"), flags=re.M | re.S
    )
    return [Block(*parts) for parts in found]


def commands(block: Block) -> Iterator[Command]:
    for session in re.split(r"^\$ ", block.text, flags=re.M)[1:]:
        line, *shown = session.splitlines()
        typed = [it.removeprefix("U> ") for it in shown if it.startswith("U> ")]
        yield Command(line, "".join(f"{it}\n" for it in typed), "\n".join(shown))


def rehearsed(page: Path) -> bool:
    return any(block.language in ("console", "dlg", "diff") for block in blocks(page))


class Stage:
    """A folder with a copy of the program, where a page is rehearsed."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name in ("ttr", "kille", "grammars"):
            shutil.copytree(ROOT / name, folder / name)
        (folder / "kille" / "grammars").symlink_to("../grammars")
        self.environment = {
            **os.environ,
            "PYTHONPATH": str(folder),
            "PYTHONUTF8": "1",
            "KILLE_MEMORY": str(folder / "memory.db"),
            "COLUMNS": "88",
        }

    def run(self, arguments: list[str], typed: str = "") -> tuple[int, str]:
        """The exit code, and what is printed on either stream."""
        done = subprocess.run(
            arguments,
            input=typed,
            cwd=self.folder,
            env=self.environment,
            text=True,
            encoding="utf-8",
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=600,
            check=False,
        )
        return done.returncode, done.stdout

    def program(self, name: str, *arguments: str, typed: str = "") -> tuple[int, str]:
        return self.run([sys.executable, "-m", RUNS[name], *arguments], typed)

    def rehearse(self, block: Block, number: int) -> None:
        """Does what the block shows, and compares."""
        match block.language:
            case "diff":
                edit(self.folder / block.file, block.text)
            # Named FILE.dlg it is that file; else a robot plays it, and a name is that
            # of its theory.
            case "dlg" if not block.file.endswith(".dlg"):
                story = self.folder / f"{number}.dlg"
                story.write_text(block.text, encoding="utf-8")
                theory = ("--theory", block.file) if block.file else ()
                code, printed = self.program(
                    "kille", "replay", "--quiet", str(story), *theory
                )
                assert code == 0, printed
            case "console":
                for command in commands(block):
                    self.type(command)
            case _ if block.file:
                (self.folder / block.file).write_text(block.text, encoding="utf-8")

    def type(self, command: Command) -> None:
        name, *arguments = shlex.split(command.line.replace("make talk", "kille talk"))
        assert name in RUNS, f"nobody knows how to rehearse: {command.line}"
        _, printed = self.program(name, *arguments, typed=command.typed)
        shown, printed = timeless(command.shown), timeless(printed)
        if not doctest.OutputChecker().check_output(shown, printed, SAME):
            pytest.fail(
                f"$ {command.line}\n--- shown\n{shown}\n--- printed\n{printed}",
                pytrace=False,
            )


def edit(file: Path, diff: str) -> None:
    """Makes the changes: what a part between `@@` lines has without its `+` lines must
    be in the file once, and becomes what it has without its `-` lines."""
    text = file.read_text(encoding="utf-8")
    for part in re.split(r"^@@\n", diff, flags=re.M):
        lines = part.splitlines(keepends=True)
        before = "".join(line[1:] for line in lines if not line.startswith("+"))
        after = "".join(line[1:] for line in lines if not line.startswith("-"))
        assert text.count(before) == 1, f"{file.name} should have once:\n{before}"
        text = text.replace(before, after)
    file.write_text(text, encoding="utf-8")


def timeless(text: str) -> str:
    """The text with the same date wherever there is one."""
    return re.sub(r"\d{4}-\d\d-\d\d \d\d:\d\d", "2026-01-31 12:00", text).strip()


@pytest.mark.slow
@pytest.mark.parametrize("page", [*filter(rehearsed, PAGES)], ids=named)
def test_what_a_page_shows_is_what_happens(page: Path, tmp_path: Path) -> None:
    stage = Stage(tmp_path)
    for number, block in enumerate(blocks(page)):
        stage.rehearse(block, number)


# --- reference -----------------------------------------------------------------------


def tables(page: Path) -> dict[str, set[str]]:
    """The names in the first columns of a page's tables, by the heading above."""
    found: dict[str, set[str]] = {}
    for section in re.split(r"^#+ ", page.read_text("utf-8"), flags=re.M)[1:]:
        heading, *lines = section.splitlines()
        rows = [line for line in lines if line.startswith("| `")]
        names = [name for row in rows for name in first_column(row)]
        assert len(names) == len(set(names)), f"{heading} has a name twice"
        if rows:
            found[heading.strip("`")] = set(names)
    return found


def first_column(row: str) -> list[str]:
    """The names in a row's first cell."""
    return re.findall(r"`(\w+)`", row.split("|")[1])


def public(value: object) -> set[str]:
    """The public names of a value, without those that it had before."""
    former = {
        name
        for owner in type(value).__mro__
        for name, what in vars(owner).items()
        if isinstance(what, Alias)
    }
    return {name for name in dir(value) if not name.startswith("_")} - former


def rooms() -> dict[str, set[str]]:
    """The public names of the inner rooms that are not at the top."""
    named = ("types", "computing", "building", "judging", "errors")
    found = {f"ttr.{it}": importlib.import_module(f"ttr.{it}") for it in named}
    return {name: {*room.__all__} - {*ttr.__all__} for name, room in found.items()}


def rules() -> dict[str, set[str]]:
    """The public names of what is done with single rules."""
    named = ("ttr.updates.rule_application", "ttr.updates.rule_notation")
    return {name: set(importlib.import_module(name).__all__) for name in named}


def playing() -> dict[str, set[str]]:
    """The public names of games, of acts and of those who act."""
    named = ("ttr.judging.type_acts", "ttr.dialogues.encounters", "ttr.updates.checks")
    found = {name: set(importlib.import_module(name).__all__) for name in named}
    door = ttr.load(ROOT / "tests" / "games" / "door.ttr").games
    return found | {"ttr.updates.Game": public(*door.values())}


def dialogues() -> dict[str, set[str]]:
    """The public names of stories, logs and transcripts."""
    spellings = ("dialogue", "stories", "logs", "transcripts")
    named = [f"ttr.dialogues.{name}" for name in spellings]
    return {name: set(importlib.import_module(name).__all__) for name in named}


def gameboards() -> dict[str, set[str]]:
    """The public names of contents, questions and the boards of the literature."""
    boards = [f"ttr.semantics.gameboards.{name}" for name in ("cooper", "kos", "ibis")]
    rooms = [f"ttr.semantics.{name}" for name in ("attitudes", "questions", "storage")]
    named = (*rooms, *boards)
    return {name: set(importlib.import_module(name).__all__) for name in named}


def property_tests() -> dict[str, set[str]]:
    """The public names of property tests; what both modules have is told once."""
    strategies = importlib.import_module("ttr.testing.strategies")
    tests = importlib.import_module("ttr.testing")
    return {
        "ttr.testing.strategies": set(strategies.__all__),
        "ttr.testing": set(tests.__all__) - set(strategies.__all__),
    }


def strings() -> dict[str, set[str]]:
    """The public names of courses of strings of events."""
    courses = importlib.import_module("ttr.semantics.string_prediction")
    begun = courses.start_course(ttr.Plus(ttr.Ind), ttr.Model())
    return {
        "ttr.semantics.string_prediction": set(courses.__all__),
        "ttr.semantics.string_prediction.Course": public(begun),
    }


def test_the_python_reference_names_what_is_public() -> None:
    described = tables(ROOT / "docs" / "reference" / "python.md")
    perceptual = importlib.import_module("ttr.semantics.perceptual")
    with Agent(sensor="synthetic:empty") as robot, Memory.transient() as memory:
        robot.do("show cup")
        robot.hear("This is a cup.")
        expected = {
            "ttr": set(ttr.__all__),
            **rooms(),
            "ttr.updates": set(importlib.import_module("ttr.updates").__all__),
            "ttr.semantics.perceptual": set(perceptual.__all__),
            "ttr.semantics.perceptual.Meaning": public(robot.meaning("cup")),
            "ttr.semantics.perceptual.Speaker": public(robot.words()),
            **probability(),
            **modality_and_learning(),
            **quantification(),
            **strings(),
            **playing(),
            **dialogues(),
            **rules(),
            **property_tests(),
            **gameboards(),
            "kille": set(kille.__all__),
            **seeing(),
            **sensing(),
            **measuring(),
            **studying(),
            **talking(),
            "ttr.Model": public(ttr.Model()),
            "ttr.judging.Judgement": public(ttr.Model().judge("a", ttr.Ind)),
            "ttr.judging.Why": public(ttr.Model().judge("a", ttr.Ind).why),
            "ttr.computing.Answer": public(ttr.subtype(ttr.Ind, ttr.Ind)),
            "ttr.Theory": public(ttr.Theory()),
            "kille.Agent": public(robot),
            "kille.Memory": public(memory),
        }
    assert described == expected


def test_what_is_public_is_described() -> None:
    """A module without an `__all__` is internal; one with it is in the reference."""
    described = tables(ROOT / "docs" / "reference" / "python.md")
    sources = [*(ROOT / "ttr").rglob("*.py"), *(ROOT / "kille").rglob("*.py")]
    public = {
        module_of(file)
        for file in sources
        if re.search(r"^__all__\b", file.read_text(encoding="utf-8"), flags=re.M)
    }
    assert public - described.keys() == {"ttr.theories"}, "see CONTRIBUTING.md"


def module_of(file: Path) -> str:
    """The dotted name of a module of the repository."""
    parts = file.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts).removesuffix(".__init__")


def sensing() -> dict[str, set[str]]:
    """The public names of the driver of a Kinect, and of recordings."""
    kinect = importlib.import_module("kille.sensors.kinect")
    sensor = importlib.import_module("kille.sensors.kinect.sensor").KinectSensor
    recordings = importlib.import_module("kille.sensors.recordings")
    with tempfile.TemporaryDirectory() as folder:
        picture = Path(folder, "cup.ppm")
        picture.write_bytes(b"P6 1 1 255\n...")
        recording = recordings.open_recording(str(picture))
    return {
        "kille.sensors.recordings": set(recordings.__all__),
        "kille.sensors.recordings.Recording": public(recording),
        "kille.sensors.kinect": set(kinect.__all__),
        "kille.sensors.kinect.sensor.KinectSensor": public(sensor),
    }


def seeing() -> dict[str, set[str]]:
    """The public names of what sees and learns words of what is seen."""
    modules = ("segment", "cues", "descriptor_index", "objects", "evidence", "colours")
    more = ("attributes", "relations", "learners", "methods")
    named = [f"kille.perception.{module}" for module in (*modules, *more)]
    named += ["kille.bus", "kille.nodes.topics", "kille.memory"]
    named += ["kille.sensors.synthetic"]
    return {name: set(importlib.import_module(name).__all__) for name in named}


def talking() -> dict[str, set[str]]:
    """The public names of what a game of one's own is made of, and played with."""
    dialogue = (
        "games",
        "tutoring",
        "moves",
        "rules",
        "meanings",
        "reference",
        "describing",
    )
    more = ("language", "strategies")
    worlds = ("worlds", "perception", "games", "schooling")
    named = [f"kille.dialogue.{module}" for module in (*dialogue, *more)]
    named += [f"kille.lab.worlds.{module}" for module in worlds]
    return {name: set(importlib.import_module(name).__all__) for name in named}


def measuring() -> dict[str, set[str]]:
    """The modules that have protocols; the public names of what these give and take."""
    modules = ("results", "theories.candidates", "measures.statistics")
    more = ("reports.result_pages", "reports.drawing")
    named = [f"kille.lab.{module}" for module in (*modules, *more)]
    found = {name: set(importlib.import_module(name).__all__) for name in named}
    package = importlib.import_module("kille.lab.protocols")
    inner = [it.name for it in pkgutil.iter_modules(package.__path__) if not it.ispkg]
    return found | {"kille.lab.protocols": {it for it in inner if has_protocol(it)}}


def studying() -> dict[str, set[str]]:
    """The public names of what studies are made of, and are read and played by."""
    modules = (
        "study",
        "dialogues",
        "study_files",
        "theories",
        "running_studies",
        "log",
        "measures",
        "reports",
        "playing_dialogues",
        "scenes",
        "robots",
        "tutors.tutor",
        "tutors.words",
    )
    named = [f"kille.lab.{module}" for module in modules]
    return {name: set(importlib.import_module(name).__all__) for name in named}


def has_protocol(module: str) -> bool:
    """Whether a module of the protocols has a public function that gives a result."""
    found = importlib.import_module(f"kille.lab.protocols.{module}")
    public = [what for name, what in vars(found).items() if not name.startswith("_")]
    functions = [
        what
        for what in filter(inspect.isfunction, public)
        if what.__module__ == found.__name__
    ]
    return any(it.__annotations__.get("return") == "Result" for it in functions)


def probability() -> dict[str, set[str]]:
    """The public names of the modules on probability."""
    named = ("ttr.probability", "ttr.semantics.random_variables")
    found = {name: set(importlib.import_module(name).__all__) for name in named}
    variable = RandomVariable("V", ttr.Ind, ttr.Rec)
    return found | {"ttr.semantics.random_variables.RandomVariable": public(variable)}


def quantification() -> dict[str, set[str]]:
    """The public names of the modules on quantifiers and what is built on them."""
    from ttr.semantics.quantifiers import every, settle

    modules = ("quantifiers", "parametric_content", "fragment")
    named = [f"ttr.semantics.{module}" for module in modules]
    found = {name: set(importlib.import_module(name).__all__) for name in named}
    counted = settle(ttr.Model(), every(ttr.Ind, ttr.Ind))
    return found | {"ttr.semantics.quantifiers.Quantification": public(counted)}


def modality_and_learning() -> dict[str, set[str]]:
    """The public names of the modules on possibilities, propositions and learning."""
    modules = (
        "semantics.modality",
        "semantics.topoi",
        "semantics.propositional_entailment",
        "semantics.learning",
        "building.level_inference",
        "judging.propositions",
    )
    named = [f"ttr.{module}" for module in modules]
    found = {name: set(importlib.import_module(name).__all__) for name in named}
    w = modal_system(w=ttr.Model())
    necessary = w.restrictive.necessary(ttr.Ind)
    return found | {
        "ttr.semantics.modality.ModalSystem": public(w),
        "ttr.semantics.modality.Notion": public(w.restrictive),
        "ttr.semantics.modality.ModalAnswer": public(necessary),
        "ttr.semantics.learning.Counts": public(Counts()),
        "ttr.semantics.learning.LogOdds": public(LogOdds((ttr.Ind,))),
    }


def test_the_commands_reference_names_every_command_and_option() -> None:
    page = (ROOT / "docs" / "reference" / "commands.md").read_text("utf-8")
    rows = re.findall(r"^\| `([^`]+)` \|", page, flags=re.M)
    for name, module in PROGRAMS.items():
        parser = importlib.import_module(module)._parser()
        described = {row for row in rows if row.startswith(name)}
        assert {synopsis(row) for row in described} == set(usages(parser, name))


def synopsis(row: str) -> tuple[str, frozenset[str]]:
    """A row as the words of the command, and its options."""
    words = row.replace("[", " ").replace("]", " ").split()
    command = takewhile(lambda word: word.isalpha() and word.islower(), words)
    return " ".join(command), frozenset(it for it in words if it.startswith("--"))


def usages(
    parser: argparse.ArgumentParser, words: str
) -> Iterator[tuple[str, frozenset[str]]]:
    """The words and the options of every command below this one."""
    inner = [
        (name, below)
        for action in parser._actions
        if isinstance(action, argparse._SubParsersAction)
        for name, below in action.choices.items()
    ]
    for name, below in inner:
        yield from usages(below, f"{words} {name}")
    if not inner:
        options = [option for it in parser._actions for option in it.option_strings]
        yield words, frozenset(options) - {"-h", "--help"}


def test_the_scenes_and_faults_of_the_reference_can_be_opened() -> None:
    page = (ROOT / "docs" / "reference" / "commands.md").read_text("utf-8")
    for name in re.findall(r"`(synthetic[^`]*)`", page):
        open_sensor(name).close()
