"""Who takes part in a comparison, and what is said of those who cannot."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kille.lab.results import ExperimentError
from kille.lab.theories.candidates import MethodFailedError, candidates

FILE = """
from polly_s_words import WORD

class Parrot:
    def learn_one(self, x, y): pass
    def predict_proba_one(self, x): return {WORD: 1}

value = 3
"""


class Keyed:
    """Remembers the keys it was given."""

    def __init__(self) -> None:
        self.keys: list[object] = []

    def learn_one(self, x: object, y: str, *, key: object = None) -> None:
        self.keys.append(key)

    def predict_proba_one(self, x: object) -> dict[str, float]:
        return {"cup": 0.5}


class Keyless:
    """Takes no key, and cannot forget."""

    def learn_one(self, x: object, y: str) -> None:
        pass

    def predict_proba_one(self, x: object) -> Any:
        return x


def failing(make: Any, x: object = None) -> str:
    with pytest.raises(MethodFailedError) as failure:
        candidates(["it"], {"it": make})["it"]().predict_proba_one(x)
    assert failure.value.name == "it"
    assert "\n" not in str(failure.value)
    return str(failure.value)


def test_a_method_of_the_users_own_file(tmp_path: Path) -> None:
    (tmp_path / "polly_s_words.py").write_text("WORD = 'polly'")
    (tmp_path / "mine.py").write_text(FILE)
    name = f"{tmp_path / 'mine.py'}:Parrot"
    learner = candidates([name], {})[name]()
    learner.learn_one(None, "cup")
    assert learner.predict_proba_one(None) == {"polly": 1.0}


def test_a_method_of_a_module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "parrots_of_mine.py").write_text(FILE.replace("from", "#"))
    name = "parrots_of_mine:Parrot"
    assert candidates([name], {}).keys() == {name}


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("defualt", "did you mean default?"),
        ("xyzzy", "there is default, kille. Your own is named FILE.py:NAME"),
        ("nowhere.py:Parrot", "there is no file nowhere.py"),
        ("no_such_module:Parrot", "there is no module no_such_module"),
        ("mine.py:Parot", "mine.py has no Parot: did you mean Parrot?"),
        ("mine.py:value", "value of mine.py makes no learner"),
        ("mine.py:", "mine.py has no object without a name"),
        ("broken.py:Parrot", "broken.py cannot be run: SyntaxError"),
    ],
)
def test_a_wrong_name_is_one_line(
    name: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("polly_s_words.py").write_text("WORD = 'polly'")
    Path("mine.py").write_text(FILE)
    Path("broken.py").write_text("def")
    known = {"default": Keyed, "kille": Keyed}
    with pytest.raises(ExperimentError) as refused:
        candidates([name], known)
    assert told in str(refused.value)


def test_keys_are_for_those_who_take_them() -> None:
    made = candidates(["one", "other"], {"one": Keyed, "other": Keyless})
    one, other = made["one"](), made["other"]()
    one.learn_one(None, "cup", key="a")
    one.learn_one(None, "cup")
    other.learn_one(None, "cup", key="a")
    assert one.keys == ["a", None]


def test_a_learner_needs_both_methods() -> None:
    assert "needs learn_one" in failing(object)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (None, "gives a degree for each word, not nothing"),
        ([0.5], "not a list"),
        ({"cup": float("nan")}, "gave 'cup' the degree nan"),
        ({"cup": -0.1}, "gave 'cup' the degree -0.1"),
        ({"cup": "much"}, "gave 'cup' the degree 'much'"),
        ({3: 0.5}, "gave 3 the degree 0.5"),
        ({"cup": 1e308}, "gave 'cup' the degree 1e+308"),
        ({"cup": 10**400}, "gave 'cup' the degree 1000"),
        ({"cup": np.zeros(2)}, "gave 'cup' the degree array"),
        ({"cup": 7}, "gave 'cup' the degree 7"),
        ({"cup": 0.8, "mug": 0.6}, "degrees sum to 1 at most, not to 1.4"),
    ],
)
def test_what_is_no_degree_is_refused(given: object, told: str) -> None:
    assert told in failing(Keyless, given)


def test_what_fails_is_named_with_its_reason() -> None:
    def cannot() -> None:
        raise OSError("no weights\nanywhere")

    assert failing(cannot).endswith("it cannot be made: OSError: no weights")


def test_who_ends_the_program_only_fails(tmp_path: Path) -> None:
    def ends() -> None:
        raise SystemExit(3)

    assert failing(ends).endswith("it cannot be made: SystemExit: 3")
    (tmp_path / "ends.py").write_text("raise SystemExit(3)")
    with pytest.raises(ExperimentError, match="cannot be run: SystemExit: 3"):
        candidates([f"{tmp_path}/ends.py:Learner"], {})


def test_what_else_it_can_do_is_left_to_it() -> None:
    learner = candidates(["it"], {"it": Keyless})["it"]()
    with pytest.raises(AttributeError):
        learner.forget("a")
