"""No study, folder of results or story runs what its user did not mean."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from kille.dialogue.meanings import record_type
from kille.dialogue.theory_files import theory_of_file
from kille.lab import log
from kille.lab.study import Theory
from kille.lab.study_files import read, read_and_check
from kille.lab.study_files.consent import refused_names
from kille.lab.theories.classifiers import learners_of
from kille.lab.theories.descriptions import describe
from ttr.safety.consent import NotAllowedError

Run = Callable[..., Any]

STUDY = """
title = "Whose code"
seeds = 1

[theories.one]
{theory}

[tutors.Ann]
{tutor}

[scenes.table]
kind = "drawn"

[[phases]]
do = "teach"
what = "nouns"
"""

CODE = """
from pathlib import Path
Path(__file__).with_name("ran").touch()

from kille.dialogue.games import TUTORING
from kille.lab.tutors.tutor import Shows
from ttr.updates import rules_of

(rule,) = [it for it in rules_of(TUTORING) if it.name == "admit_name"]


class Learner:
    def learn_one(self, x, label):
        pass

    def predict_proba_one(self, x):
        return {}


class Tutor:
    def __init__(self, name, words):
        self.name = name

    def turns(self, task):
        yield Shows(task.occasion)
"""

SIMULATED = 'kind = "simulated"'

SECRET = "root:x:0:0:of nobody's business"


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder for a study, and beside it one with Python that nobody meant."""
    for folder in ("mine", "mine/below", "theirs"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "own.py").write_text(CODE)
    (tmp_path / "mine" / "link.py").symlink_to("../theirs/own.py")
    (tmp_path / "mine" / "linked").symlink_to("../theirs")
    (tmp_path / "mine" / "secret").write_text(SECRET)
    (tmp_path / "mine" / "hidden.ttr").symlink_to("secret")
    (tmp_path / "mine" / "hidden.dlg").symlink_to("secret")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def study(theory: str = "", tutor: str = SIMULATED) -> Path:
    path = Path("mine", "study.toml")
    path.write_text(STUDY.format(theory=theory, tutor=tutor))
    return path


def ran(home: Path) -> list[str]:
    """The folders whose Python was run."""
    return sorted(str(it.parent.relative_to(home)) for it in home.rglob("ran"))


WAYS = {
    "rules": 'rules = "{}:rule"',
    "noun": 'learners.noun = "{}:Learner"',
    "relation": 'learners.relation = "{}:Learner"',
    "tutor": "",
}


def by(way: str, python: str) -> Path:
    """A study that names Python in one of the ways."""
    if way == "tutor":
        return study("", f'kind = "own"\nmake = "{python}:Tutor"')
    return study(WAYS[way].format(python))


ELSEWHERE = [
    "../theirs/own.py",
    "{home}/theirs/own.py",
    "below/../../theirs/own.py",
    "link.py",
    "linked/own.py",
]


@pytest.mark.parametrize("way", WAYS)
def test_a_study_runs_no_python_from_elsewhere(
    kille: Run, home: Path, way: str
) -> None:
    for python in ELSEWHERE:
        path = by(way, python.format(home=home))
        for action in ("check", "run"):
            done = kille("experiment", action, str(path))
            assert done.code == 2
            assert done.err.startswith(f"kille: {path}:")
            assert "lies in another folder: allow it with --allow" in done.err
            assert done.err.count("\n") == 1
    assert ran(home) == []


@pytest.mark.parametrize("way", ["noun", "relation", "tutor"])
def test_a_study_imports_no_module_from_elsewhere(
    kille: Run, home: Path, way: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    (home / "here.py").write_text(CODE)  # in the working directory
    monkeypatch.syspath_prepend(home / "theirs")
    for module in ("here", "own2", "subprocess", "antigravity", "theirs.own", "os"):
        done = kille("experiment", "check", str(by(way, module)))
        assert done.code == 2
        assert f"there is no module {module} in this folder" in done.err
    assert ran(home) == []


@pytest.mark.parametrize("way", WAYS)
def test_a_study_runs_python_from_its_folder(kille: Run, home: Path, way: str) -> None:
    assert kille("experiment", "check", str(by(way, "own.py"))).code == 0
    assert kille("experiment", "check", str(by(way, "below/own.py"))).code == 0
    assert ran(home) == ["mine", "mine/below"]


def test_a_module_in_the_folder_is_python_of_the_folder(kille: Run, home: Path) -> None:
    (home / "mine" / "beside_it.py").write_text(CODE)
    assert kille("experiment", "check", str(by("tutor", "beside_it"))).code == 0
    assert ran(home) == ["mine"]


@pytest.mark.parametrize("way", WAYS)
def test_a_user_may_allow_more_or_nothing(kille: Run, home: Path, way: str) -> None:
    path = by(way, "own.py")
    for action in ("check", "run"):
        done = kille("experiment", action, str(path), "--no-python")
        assert done.code == 2
        assert "own.py is Python, which may not be run here" in done.err
    assert ran(home) == []
    path = by(way, "../theirs/own.py")
    assert kille("experiment", "check", str(path), "--allow", "theirs").code == 0
    assert ran(home) == ["theirs"]


def test_a_study_without_python_is_played_without_python(
    kille: Run, home: Path
) -> None:
    done = kille("experiment", "run", str(study()), "--no-python", "--workers", "1")
    assert done.code == 0


@pytest.mark.parametrize(
    ("theory", "tutor"),
    [
        ('rules = "hidden.ttr"', SIMULATED),
        ('meanings = "hidden.ttr"', SIMULATED),
        ('meanings = "secret"', SIMULATED),
        ('meanings = "/etc/passwd"', SIMULATED),
        ('meanings = "/dev/zero"', SIMULATED),
        ("", 'kind = "scripted"\nfile = "hidden.dlg"'),
        ("", 'kind = "scripted"\nfile = "secret"'),
        ("", 'kind = "scripted"\nfile = "/etc/passwd"'),
        ('grammar = "grammar"', SIMULATED),
    ],
)
def test_a_study_tells_nothing_of_other_files(
    kille: Run, home: Path, theory: str, tutor: str
) -> None:
    (home / "mine" / "grammar").mkdir()
    (home / "mine" / "grammar" / "tutor.en.lark").symlink_to("../secret")
    path = study(theory, tutor)
    assert [*refused_names(read(path))]
    done = kille("experiment", "check", str(path))
    assert (done.code, done.err.count("\n")) == (2, 1)
    assert "root:x" not in done.err + done.out


def test_a_theory_of_a_study_imports_from_the_folder_of_the_study(
    kille: Run, home: Path
) -> None:
    (home / "mine" / "base.ttr").write_text("basic Own\n")
    (home / "theirs" / "base.ttr").write_text("basic Own\n")
    rules = home / "mine" / "below" / "rules.ttr"
    path = study('rules = "below/rules.ttr"')
    rules.write_text('import "../base.ttr"\n')
    assert "rules.ttr has no rule" in kille("experiment", "check", str(path)).err
    rules.write_text('import "../../theirs/base.ttr"\n')
    assert "lies in another folder" in kille("experiment", "check", str(path)).err
    done = kille("experiment", "check", str(path), "--allow", "theirs")
    assert "rules.ttr has no rule" in done.err


def test_meanings_import_from_the_folder_of_the_study(kille: Run, home: Path) -> None:
    import kille.grammars as packaged

    tutor = Path(packaged.__path__[0], "tutor.ttr").read_text()
    (home / "mine" / "tutor.ttr").write_text(tutor)
    (home / "mine" / "below" / "own.ttr").write_text('import "../tutor.ttr"\n')
    path = study('meanings = "below/own.ttr"')
    assert kille("experiment", "check", str(path)).code == 0


def test_what_lies_in_the_working_directory_is_not_run(home: Path) -> None:
    for module in ("random", "pickle", "kille", "ttr"):
        text = "from pathlib import Path\nPath(__file__).with_name('ran').touch()\n"
        (home / f"{module}.py").write_text(text)
    own = Theory("own", meanings={"It": "[x : Ind, look : Look]"})
    assert describe(own)["meanings"]["It"] is not record_type("It")  # type: ignore[index]
    assert ran(home) == []


def test_a_file_of_meanings_is_a_theory(home: Path) -> None:
    for own in ("/etc/passwd", "mine/secret", "mine/hidden.ttr"):
        with pytest.raises(NotAllowedError) as caught:
            theory_of_file(own)
        assert "root:x" not in str(caught.value)


# --- folders of results --------------------------------------------------------------


@pytest.fixture
def results(kille: Run, home: Path) -> Path:
    """The results of a study that names Python."""
    path = by("noun", "own.py")
    words = "--out", "results", "--workers", "1"
    assert kille("experiment", "run", str(path), *words).code == 0
    (home / "mine" / "ran").unlink()
    return Path("results")


@pytest.mark.parametrize("action", ["resume", "replay"])
def test_a_log_of_a_study_runs_nothing(
    kille: Run, home: Path, results: Path, action: str
) -> None:
    for options in ((), ("--no-python",), ("--allow", "theirs")):
        done = kille("experiment", action, str(results), *options, "--workers", "1")
        assert (done.code, done.out, done.err.count("\n")) == (2, "", 1)
        assert done.err.startswith("kille: results has a study that names Python, ")
        assert ("--trust" in done.err) == ("--no-python" not in options)
    assert ran(home) == []


@pytest.mark.parametrize("action", ["resume", "replay"])
def test_a_log_of_a_study_may_be_trusted(
    kille: Run, home: Path, results: Path, action: str
) -> None:
    words = "experiment", action, str(results), "--workers", "1"
    done = kille(*words, "--trust")
    assert done.code == 0
    own = (home / "mine" / "own.py").resolve()
    assert done.out.startswith(f"running {own}, which the log names\n")
    assert ran(home) == ["mine"]
    assert kille(*words, "--study", "mine/study.toml").code == 0
    assert kille(*words, "--study", "mine/study.toml", "--no-python").code == 2


def test_a_report_runs_nothing_unless_it_may(
    kille: Run, home: Path, results: Path
) -> None:
    other = kille("experiment", "run", "mine/study.toml", "--workers", "1")
    assert other.code == 0
    for it in home.rglob("ran"):
        it.unlink()
    rules = '[theories.one]\nrules = "own.py:rule"'
    with sqlite3.connect(results / "log.db") as connection:
        connection.execute(
            "UPDATE about SET value = replace(value, '[theories.one]', ?) "
            "WHERE name = 'source'",
            (rules,),
        )
    assert kille("experiment", "report", str(results)).code == 0
    assert (
        "own.py is Python, which may not be run"
        in (results / "report.html").read_text()
    )
    both = "compare", str(results), "study.results"
    assert kille("experiment", *both).code == 0
    assert kille("experiment", "show", str(results)).code == 0
    assert ran(home) == []
    assert kille("experiment", "report", str(results), "--trust").code == 0
    assert ran(home) == ["mine"]


def test_a_log_that_says_it_is_from_elsewhere_runs_nothing(
    kille: Run, home: Path, results: Path
) -> None:
    """Whoever goes on with a study plays what he named, and not what the log has."""
    with sqlite3.connect(results / "log.db") as connection:
        connection.execute("UPDATE about SET value = '../theirs' WHERE name = 'folder'")
    words = "--out", str(results), "--workers", "1"
    assert kille("experiment", "run", "mine/study.toml", *words).code == 0
    assert ran(home) == ["mine"]
    consent = log.study(results).theories["one"].consent
    assert consent is not None
    with pytest.raises(NotAllowedError, match="may not be run here"):
        consent.check_python("own.py", home / "theirs")


# --- from Python, and for the robot --------------------------------------------------


def test_who_makes_a_theory_in_python_names_what_it_runs(home: Path) -> None:
    learners_of(Theory("one", learners={"noun": f"{home}/theirs/own.py:Learner"}))
    assert ran(home) == ["theirs"]


def test_what_is_checked_from_python_runs_its_folder_alone(home: Path) -> None:
    with pytest.raises(Exception, match="lies in another folder"):
        read_and_check(by("noun", "link.py"))
    assert ran(home) == []


def test_a_story_for_the_robot_runs_nothing(kille: Run, home: Path) -> None:
    (home / "mine" / "a.dlg").write_text("@ game own.py:rule\nU> Hello.\n")
    done = kille("replay", "mine/a.dlg")
    assert (done.code, done.err.count("\n")) == (2, 1)
    assert "is played by `ttr play`" in done.err
    assert ran(home) == []
