"""Studies as files: what they say, and all that is wrong with them, line by line."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.strategies import strategy
from kille.lab import scenes, tutors
from kille.lab.errors import StudyError
from kille.lab.protocols import phases
from kille.lab.settings import Key, Setting, setting_problems
from kille.lab.study import Run, Study
from kille.lab.study_files import parse, read, read_and_check
from kille.lab.study_files.problems import line_of, lines_of
from kille.lab.study_files.shape import LEARNERS, THEORY
from kille.lab.study_files.shape import STUDY as STUDY_KEYS
from kille.lab.theories.classifiers import NAMES

STUDY = """\
title = "Does it pay to be sure?"
about = '''
Two ways
to be sure.'''
turns = 40
seeds = 3

[theories.plain]
[theories.sure]
about = "It says what it thinks."
mode = "driven"
without = [
    "hedge_name",  # of rivals
]
strategy.bands.sure = 0.5
[theories.proto]
learners = { noun = "prototype", relation = "own.py:Mine" }
rules = "rules/own.py:RULES"
grammar = "mine"

[tutors.Ann]
kind = "simulated"
errors = 0.1

[scenes."a table"]
kind = "drawn"

[[phases]]
do = "teach"
what = "nouns"

[[phases]]
do = "ask"

[[phases]]
do = "ask"
name = "ask"
"""

PATH = Path("studies/sure.toml")


def study(text: str = STUDY) -> Study:
    return parse(text, PATH)


def faults(text: str) -> tuple[str, ...]:
    with pytest.raises(StudyError) as raised:
        parse(text, PATH)
    return raised.value.faults


def changed(old: str, new: str) -> tuple[str, ...]:
    assert old in STUDY
    return faults(STUDY.replace(old, new, 1))


# --- what it says ---------------------------------------------------------------------


def test_a_study_says_what_is_in_the_file() -> None:
    found = study()
    assert found.title == "Does it pay to be sure?"
    assert found.about == "Two ways\nto be sure."
    assert list(found.theories) == ["plain", "sure", "proto"]
    assert found.theories["sure"].without == ("hedge_name",)
    assert found.theories["sure"].strategy == {"bands": {"sure": 0.5}}
    assert found.tutors["Ann"].settings == {"errors": 0.1}
    assert found.seeds == (1, 2, 3)
    assert found.turns == 40
    assert found.source == STUDY


def test_paths_begin_where_the_file_is() -> None:
    theory, folder = study().theories["proto"], PATH.resolve().parent
    assert theory.rules == f"{folder / 'rules/own.py'}:RULES"
    assert theory.grammar == folder / "mine"
    assert theory.learners["relation"] == f"{folder / 'own.py'}:Mine"
    assert theory.learners["noun"] == "prototype"


def test_phases_have_names_of_their_own() -> None:
    assert [it.name for it in study().phases] == ["teach", "ask", "ask 2"]
    assert study().phases[0].settings == {"what": "nouns"}


@pytest.mark.parametrize("key", ["rules", "grammar", "meanings"])
def test_what_is_written_as_empty_is_not_set(key: str) -> None:
    text = STUDY.replace("[theories.plain]", f'[theories.plain]\n{key} = ""')
    assert study(text).theories["plain"] == study().theories["plain"]


def test_paths_may_begin_at_home(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    text = STUDY.replace('"rules/own.py', '"~/own.py').replace('"mine"', '"~/mine"')
    theory = study(text).theories["proto"]
    assert theory.rules == f"{tmp_path}/own.py:RULES"
    assert theory.grammar == tmp_path / "mine"


def test_runs_to_be_compared_are_in_a_row() -> None:
    runs = list(study().runs())
    assert len(runs) == 9
    assert runs[:3] == [
        Run(it, "Ann", "a table", 1) for it in ("plain", "sure", "proto")
    ]
    assert len({run.pair for run in runs[:3]}) == 1


@pytest.mark.parametrize(
    ("seeds", "wanted"), [("2", (1, 2)), ("[7, 3]", (7, 3)), ("[0]", (0,))]
)
def test_seeds_are_a_number_or_a_list(seeds: str, wanted: tuple[int, ...]) -> None:
    assert study(STUDY.replace("seeds = 3", f"seeds = {seeds}")).seeds == wanted


def test_a_file_is_read_as_its_text(tmp_path: Path) -> None:
    file = tmp_path / "sure.toml"
    file.write_text(STUDY)
    assert read(file) == parse(STUDY, file)


# --- what is wrong --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "line", "told"),
    [
        ("title", "titel", 1, "a study has no titel: did you mean title?"),
        ("turns = 40", "turns = 0", 5, "expected a whole number from 1 to 1000000"),
        ("seeds = 3", "seeds = 0", 6, "there is no seed"),
        ("seeds = 3", "seeds = 9000000000", 6, "write 100000 at most"),
        ("seeds = 3", "seeds = [1, 1]", 6, "seeds of a study: 1 is there twice"),
        ("seeds = 3", "seeds = [1.5]", 6, "expected a whole number from 0 to 429"),
        ("seeds = 3", "seeds = 1.5", 6, "study: expected a whole number from 0"),
        ('"driven"', '"drivn"', 11, "(did you mean driven?)"),
        ("[theories.plain]", '[theories."a/b"]', 8, "is no name"),
        ("without = [", "without = [3,", 12, "expected a text, found 3"),
        ("strategy.bands.sure = 0.5", "strategy = 3", 15, "expected a table"),
        ("noun = ", "nuon = ", 17, "did you mean noun?"),
        ('"simulated"', '"simulate"', 22, "did you mean simulated?"),
        ("errors = 0.1", "erors = 0.1", 23, "did you mean errors?"),
        ("errors = 0.1", "errors = 7", 23, "expected a number from 0 to 1, found 7"),
        ('kind = "drawn"', "", 25, "a table needs kind: it is one of drawn"),
        ('do = "teach"', 'do = "tech"', 29, "did you mean teach?"),
        ('what = "nouns"', 'what = "noun"', 30, "(did you mean nouns?)"),
        ('title = "Does it pay to be sure?"', "title = ' '", 1, 'write title = "…"'),
        ("seeds = 3", "seeds = [5000000000]", 6, "from 0 to 4294967295, found 500"),
        ("seeds = 3", "seeds = []", 6, "expected one at least, found an empty list"),
        ("[theories.plain]", '[theories."a\\tb"]', 8, "is no name"),
        ('"hedge_name",', '"hedge_name", "hedge_name",', 12, '"hedge_name" is there'),
        ('kind = "simulated"', 'knd = "simulated"', 22, "Ann needs kind, and has knd"),
        ("errors = 0.1", 'calls = ["mug"]', 23, "expected a table, found a list"),
        ("errors = 0.1", "habit = 99", 23, "expected a number from 0 to 10"),
        ("errors = 0.1", 'vocabulary = ["a", "a"]', 23, '"a" is there twice'),
        ("errors = 0.1", 'frame = "VIEWER"', 23, "(did you mean viewer?)"),
        ('kind = "drawn"', 'kind = "drawn"\nkinds = ["cup", "cup"]', 27, '"cup" is'),
        ('kind = "drawn"', 'kind = "drawn"\nhues = ["red", "red"]', 27, '"red" is'),
        ('kind = "drawn"', 'kind = "around"\nrings = [0.1, 0.1]', 27, "0.1 is there"),
        ('kind = "drawn"', 'kind = "around"\nfront = "up"', 27, 'expected "", any, aw'),
        ('kind = "drawn"', 'kind = "statements"\nfolder = ""', 27, "expected a text"),
        ('do = "teach"', 'do = "test"', 29, "it is one of teach, ask, practise"),
        ('what = "nouns"', "rounds = 1000000000", 30, "whole number from 1 to 1000"),
        ('name = "ask"', 'name = "a\\nb"', 37, "expected one line, found 'a\\nb'"),
        ('name = "ask"', "name = 3", 37, "name of phase 3: expected a text, found 3"),
        ('name = "ask"', 'name = ["a"]', 37, "expected a text, found a list"),
        ("errors = 0.1", "patience = 1.5", 23, "expected a whole number from 0 on"),
    ],
)
def test_a_mistake_is_one_line(old: str, new: str, line: int, told: str) -> None:
    [fault] = changed(old, new)
    assert fault.startswith(f"{PATH}:{line}: ")
    assert told in fault
    assert "\n" not in fault


def test_all_mistakes_are_told_at_once_in_order() -> None:
    text = STUDY.replace("errors", "erors").replace('"ask"', '"aks"', 1)
    found = faults(text.replace("about =", "abuot ="))
    places = [int(it.split(":")[1]) for it in found]
    assert places == sorted(places)
    assert len(found) == 4


@pytest.mark.parametrize(
    ("old", "new", "line", "told"),
    [
        ("[[phases]]", "[[phase]]", 28, "a study has no phase: did you mean phases?"),
        ('[scenes."a table"]', "[scene.a]", 25, "did you mean scenes?"),
        ("[theories.plain]", "[[theories]]", 8, "found a list: write [theories.NAME]"),
    ],
)
def test_a_header_is_told_where_it_stands(
    old: str, new: str, line: int, told: str
) -> None:
    text = STUDY.replace(old, new)
    if "theories" in new:
        text = text.replace("[theories.sure]", "[[theories]]")
        text = text.replace("[theories.proto]", "[[theories]]")
    assert any(it.startswith(f"{PATH}:{line}: ") and told in it for it in faults(text))


def test_one_table_in_the_place_of_several_is_told_how_to_write_it() -> None:
    text = STUDY.split("[[phases]]")[0] + '[phases]\ndo = "teach"\n'
    assert faults(text)[0].endswith('found a table: write [[phases]] and do = "…"')


def test_no_phases_are_no_study() -> None:
    text = "phases = []\n" + STUDY.split("[[phases]]")[0]
    [fault] = faults(text)
    assert fault.startswith(f"{PATH}:1: phases of a study: expected one at least")


def test_seeds_are_told_once_where_they_are_misspelt() -> None:
    assert [it.partition(": ")[2] for it in changed("seeds = 3", "seed = 3")] == [
        "a study has no seed: did you mean seeds?"
    ]


@pytest.mark.parametrize("table", ["theories", "tutors", "scenes", "phases"])
def test_what_is_lacking_is_told_with_how_to_write_it(table: str) -> None:
    parts = STUDY.split("\n[")
    others = [it for it in parts if not it.lstrip("[").startswith(table)]
    assert len(others) < len(parts)
    assert any(f"needs {table}: write [" in it for it in faults("\n[".join(others)))


def test_what_is_no_toml_is_told_with_its_line() -> None:
    [fault] = faults("title = 'a'\nseeds = = 3\n")
    assert fault.startswith(f"{PATH}:2: this is no TOML: ")
    [fault] = faults("title = 'a")
    assert fault.startswith(f"{PATH}:1: this is no TOML: ")
    [fault] = faults(f"seeds = {'9' * 5000}")
    assert fault.startswith(f"{PATH}:1: this is no TOML: ")
    [fault] = faults('about = "one\u2028line"\nseeds = [1,')
    assert fault.startswith(f"{PATH}:2: this is no TOML: ")
    [fault] = faults(f"seeds = {'[' * 5000}")
    assert fault.startswith(f"{PATH}:1: this is no TOML: ")


@pytest.mark.parametrize(
    ("old", "new", "line", "told"),
    [
        ("seeds = 3", "seeds = 3\nseeds = 4", 7, "seeds is there twice"),
        ("[theories.sure]", "[theories.plain]", 9, "[theories.plain] is there twice"),
        ('do = "ask"\nname', 'do = "ask"\n[phases]\nname', 37, "write [[phases]] each"),
        ("strategy.bands", "learners = {}\nlearners.a", 16, "between { and }: write"),
        ('"simulated"', "simulated", 22, 'a text has quotes, "…"'),
        ('"simulated"', "“simulated”", 22, "between straight quotes"),
        ("errors = 0.1", "orients = True", 23, "write true or false, in small letters"),
        ("errors = 0.1", "errors = .1", 23, "a number begins with a digit, 0.1"),
        ("errors = 0.1", "errors = 0,1", 23, "a number has a point, 0.1"),
        ("seeds = 3", "seeds: 3", 6, "write KEY = VALUE"),
        ("seeds = 3", "seeds = 3 4", 6, "see https://toml.io"),
    ],
)
def test_slips_in_toml_are_told_with_what_to_write(
    old: str, new: str, line: int, told: str
) -> None:
    [fault] = changed(old, new)
    assert fault.startswith(f"{PATH}:{line}: this is no TOML: ")
    assert told in fault
    assert "('" not in fault


def test_a_mark_of_byte_order_is_no_mistake(tmp_path: Path) -> None:
    """Some editors put it at the beginning of a file."""
    file = tmp_path / "sure.toml"
    file.write_text(STUDY, encoding="utf-8-sig")
    assert read(file) == parse(STUDY, file)


def test_a_name_much_like_that_of_a_file_is_told(tmp_path: Path) -> None:
    (tmp_path / "sure.toml").write_text(STUDY)
    with pytest.raises(StudyError, match=r"sur\.toml: did you mean sure\.toml\?$"):
        read(tmp_path / "sur.toml")


@pytest.mark.parametrize("make", [Path.mkdir, lambda path: path.write_bytes(b"\xff")])
def test_a_file_that_cannot_be_read_is_told_in_one_line(tmp_path: Path, make) -> None:
    with pytest.raises(StudyError, match=r"^there is no file [^\n]+$"):
        read(tmp_path / "none.toml")
    make(tmp_path / "odd.toml")
    with pytest.raises(StudyError, match=r"^[^\n]+(folder|UTF-8)[^\n]*$"):
        read(tmp_path / "odd.toml")


@given(
    st.integers(0, len(STUDY)),
    st.integers(0, 12),
    st.text("[]{}=\"'.,#\n \\ab01\u00e5", max_size=4),
)
def test_whatever_is_written_is_a_study_or_told(at: int, gone: int, new: str) -> None:
    text = STUDY[:at] + new + STUDY[at + gone :]
    try:
        found: tuple[str, ...] = ()
        assert parse(text, PATH).source == text
    except StudyError as error:
        found = error.faults or ("nothing",)
    assert all(it.startswith(f"{PATH}:") for it in found)
    assert not any("\n" in it for it in found)


# --- on which line --------------------------------------------------------------------

VALUES = ("3", "'x'", "[1,\n 2]", '"""a\nb"""', "{ a = 1 }", "[ # x\n]", "'#[no]'")


@given(
    st.lists(
        st.tuples(st.sampled_from("abcd"), st.sampled_from(VALUES)),
        unique_by=lambda it: it[0],
    ),
    st.lists(st.tuples(st.booleans(), st.sampled_from(VALUES)), max_size=4),
)
def test_every_key_is_found_on_its_line(
    plain: list[tuple[str, str]], tables: list[tuple[bool, str]]
) -> None:
    text, wanted = "# a comment\n\n", dict[Key, int]()
    for name, value in plain:
        wanted[name,] = text.count("\n") + 1
        text += f"{name} = {value}\n"
    counts = 0
    for number, (listed, value) in enumerate(tables):
        header = "[[many]]" if listed else f"[one.t{number}]"
        key: Key = ("many", counts) if listed else ("one", f"t{number}")
        counts += listed
        wanted[key] = text.count("\n") + 1
        wanted[*key, "x", "y"] = wanted[key] + 2
        text += f"{header}\n\nx.y = {value}\n"
    tomllib.loads(text)
    found = lines_of(text)
    assert {key: line_of(found, key) for key in wanted} == wanted


@pytest.mark.parametrize("odd", ["\u2028", "\x85"])
def test_lines_are_those_of_toml(odd: str) -> None:
    found = lines_of(f"title = 'a{odd}b'\r\nseeds = 3\r\n")
    assert found == {("title",): 1, ("seeds",): 2}


def test_what_has_no_line_is_where_it_is_in() -> None:
    assert line_of(lines_of(STUDY), ("theories", "sure", "rules")) == 9
    assert line_of(lines_of(STUDY), ("nowhere",)) == 1


# --- settings -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("setting", "fits", "unfit_"),
    [
        (Setting(), "a", 3),
        (Setting(int), 3, 3.0),
        (Setting(float, most=1.0), 1, 1.1),
        (Setting(bool), False, 0),
        (Setting(float), 3, True),
        (Setting(float), 0.5, math.nan),
        (Setting(float), 10**400, math.inf),
        (Setting(among=("a", "b")), "b", "c"),
        (Setting(int, several=True), [1, 2], [1, "a"]),
        (Setting(int, several=True), [], 1),
        (Setting(dict), {}, []),
        (Setting(int, needed=True, several=True), [1], []),
        (Setting(needed=True), "a", " "),
    ],
)
def test_a_value_fits_or_is_told(setting: Setting, fits, unfit_) -> None:
    assert setting.problem_with(fits) == ""
    assert setting.problem_with(unfit_).startswith("expected ")


def test_nothing_is_in_a_list_twice_unless_that_says_something() -> None:
    assert Setting(several=True).problem_with(["a", "b", "a"]) == '"a" is there twice'
    assert Setting(float, several=True).problem_with([1, 1.0]) == "1 is there twice"
    assert not Setting(several=True, twice=True).problem_with(["a", "a"])


@pytest.mark.parametrize(
    ("kinds", "free"),
    [(tutors.SETTINGS, {("several", "of")}), (scenes.SETTINGS, set())],
)
def test_only_tutors_may_be_named_twice(
    kinds: Mapping[str, Mapping[str, Setting]], free: set[tuple[str, str]]
) -> None:
    lists = {
        (kind, key): it
        for kind, settings_ in kinds.items()
        for key, it in settings_.items()
        if it.several
    }
    assert {key for key, it in lists.items() if it.twice} == free


def test_a_slip_in_a_needed_key_is_told_once() -> None:
    declared = {"folder": Setting(needed=True)}
    assert len(list(setting_problems({"foldr": "a"}, declared, "a scene"))) == 1
    assert len(list(setting_problems({}, declared, "a scene"))) == 1


# --- the reference --------------------------------------------------------------------

PAGE = Path(__file__).parents[4] / "docs" / "reference" / "studies.md"

ALIKE = {
    "ask": "teach",
    "practise": "teach",
    "talk": "teach",
    "swap": "change_tutor",
}
"""What has the keys of another, and says so."""


def described(heading: str) -> dict[str, str]:
    """The keys in the first table below a heading of the page, with their defaults."""
    below = PAGE.read_text("utf-8").split(f"\n{heading}\n", 1)[1]
    rows = re.split(r"^#+ |\n\n(?=In )", below, maxsplit=1, flags=re.M)[0]
    found = re.findall(r"^\| `(\w+)` \|[^|]*\| (.+?) \|", rows, flags=re.M)
    return {key: default.strip("`") for key, default in found}


def declared(settings_: Mapping[str, Setting]) -> dict[str, str]:
    """The keys of settings, with the defaults as they would be written."""
    return {
        key: "needed" if one.needed else _written(one.default)
        for key, one in settings_.items()
    }


def _written(default: object) -> str:
    if isinstance(default, tuple):
        return f"[{', '.join(map(_written, default))}]"
    if isinstance(default, str):
        return f'"{default}"'
    return str(default).lower() if isinstance(default, bool) else str(default)


@pytest.mark.parametrize("heading", ["Tutors", "Scenes", "Phases"])
def test_the_reference_has_every_kind_with_all_its_settings(heading: str) -> None:
    kinds = {"Tutors": tutors, "Scenes": scenes, "Phases": phases}[heading].SETTINGS
    below = PAGE.read_text("utf-8").split(f"\n## {heading}\n", 1)[1]
    section = re.split(r"^## ", below, maxsplit=1, flags=re.M)[0]
    found = re.findall(r"^### `(\w+)`$", section, flags=re.M)
    assert [it for it in kinds if it != "swap"] == found
    for kind, settings_ in kinds.items():
        wanted = declared(settings_)
        if kind == "people":
            simulated = described("### `simulated`")
            assert {**simulated, **described("### `people`")} == wanted
        else:
            assert described(f"### `{ALIKE.get(kind, kind)}`") == wanted, kind


def test_the_reference_has_all_that_stands_in_a_study_and_a_theory() -> None:
    assert described("## A study").keys() == STUDY_KEYS.keys()
    assert described("## A theory").keys() == THEORY.keys()
    assert described("### Learners").keys() == LEARNERS.keys()
    assert described("## A theory")["mode"] == f'"{strategy().mode}"'
    assert described("## A theory")["wording"] == f'"{strategy().wording}"'


def test_the_reference_names_all_learners() -> None:
    page = PAGE.read_text("utf-8")
    of = {"nouns": "noun", "adjectives": "adjective", "relations": "relation"}
    for seen, intro in (
        ("simulated", "In simulated scenes:"),
        ("whole", "In scenes that the whole robot sees:"),
    ):
        table = page.split(intro, 1)[1].split("\n\n")[1]
        rows = re.findall(r"^\| (`.+?) \| (\w+) \|", table, flags=re.M)
        for kind in NAMES[seen]:
            own = [names for names, said in rows if of.get(said, kind) == kind]
            names = {it for row in own for it in re.findall(r"`(\w+)`", row)}
            assert names == set(NAMES[seen][kind]), (seen, kind)


def test_the_study_in_the_reference_is_fine(tmp_path: Path) -> None:
    text = PAGE.read_text("utf-8").split("```toml\n", 1)[1].split("```", 1)[0]
    (tmp_path / "sure.toml").write_text(text)
    assert len(list(read_and_check(tmp_path / "sure.toml").runs())) == 40


def with_plan(plan: str) -> str:
    return STUDY.replace("turns = 40\n", f"turns = 40\n{plan}\n")


def test_a_study_says_what_it_compares_and_by_which_measure(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    plain = parse(STUDY, path)
    assert (plain.main, plain.contrasts) == ("accuracy", ())
    text = with_plan('main = "kappa"\ncontrasts = [["plain", "sure"]]')
    planned = parse(text, path)
    assert (planned.main, planned.contrasts) == ("kappa", (("plain", "sure"),))


@pytest.mark.parametrize(
    ("plan", "told"),
    [
        ('main = "acuracy"', "main of a study: expected accuracy, kappa, "),
        ('main = "acuracy"', "(did you mean accuracy?)"),
        ("contrasts = 1", "expected a list, each a list, found 1"),
        ('contrasts = ["plain"]', 'expected a list, found "plain"'),
        ('contrasts = [["plain"]]', "a contrast is of two theories: write contrasts ="),
        ('contrasts = [["plain", 1]]', "a contrast is of two theories: write"),
        ('contrasts = [["sure", "sure"]]', 'of two theories, found "sure" twice'),
        ('contrasts = [["plain", "shure"]]', 'no theory "shure": did you mean sure?'),
        (
            'contrasts = [["plain", "sure"], ["sure", "plain"]]',
            'the contrast of "plain" and "sure" is there twice',
        ),
    ],
)
def test_a_plan_that_cannot_be_is_told_on_its_line(
    plan: str, told: str, tmp_path: Path
) -> None:
    with pytest.raises(StudyError) as caught:
        parse(with_plan(plan), tmp_path / "a.toml")
    line, *_ = str(caught.value).splitlines()
    assert told in line
    assert "a.toml:6: " in line
