"""The names a user writes, and where they come from."""

import subprocess
import sys
import warnings
from importlib import import_module
from pathlib import Path
from pkgutil import resolve_name

import pytest

import ttr
from ttr.aliases import FORMER_MODULES, FORMER_NAMES, former_names
from ttr.hooks import Hook, hook


def test_every_public_name_is_there():
    for name in ttr.__all__:
        assert getattr(ttr, name) is not None
    assert len(set(ttr.__all__)) == len(ttr.__all__)


def test_every_public_name_is_documented():
    undocumented = [
        name
        for name in ttr.__all__
        if callable(getattr(ttr, name)) and not getattr(ttr, name).__doc__
    ]
    assert undocumented == []


def test_a_name_that_is_not_there():
    with pytest.raises(AttributeError, match="'ttr' has no attribute 'nonesuch'"):
        _ = ttr.nonesuch


def test_a_name_that_something_had_before_warns_and_works():
    theory = ttr.Theory()
    with pytest.warns(DeprecationWarning, match="Theory.related is now .*axiom_heads"):
        assert theory.related == theory.axiom_heads


NEVER_WARN = ("ttr.Undecided", "ttr.errors.Undecided", "ttr.strategies")


IMPORT = """
import sys, warnings
with warnings.catch_warnings(record=True) as said:
    warnings.simplefilter("always")
    import {former} as former
assert former is sys.modules["{now}"], former
assert [str(it.message) for it in said][-1:] == ["{former} is now {now}"], said
assert said[-1].filename == "<string>"
"""


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
@pytest.mark.parametrize("former", sorted(FORMER_MODULES))
def test_a_former_module_is_the_one_that_took_its_place(former):
    now = FORMER_MODULES[former]
    sys.modules.pop(former, None)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        assert import_module(former) is import_module(now)
    told = [str(it.message) for it in said][-1:]
    assert told == ([] if former in NEVER_WARN else [f"{former} is now {now}"])


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_module_that_never_was_is_not_found_in_a_former_package():
    with pytest.raises(ModuleNotFoundError, match="nonesuch"):
        import_module("ttr.gameboards.nonesuch")


def test_a_former_module_warns_where_it_is_imported():
    former = "ttr.gameboards.ibis.terms"
    text = IMPORT.format(former=former, now=FORMER_MODULES[former])
    run = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True)
    assert run.stderr == ""


def test_every_declared_operation_is_provided_by_one_module():
    declared = {}
    for name, provider in ttr.PROVIDERS.items():
        module, _, operation = name.rpartition(".")
        declared[name] = getattr(import_module(module), operation)
        assert isinstance(declared[name], Hook)
        assert f"{operation}.provided_by" in Path(
            import_module(provider).__file__
        ).read_text(encoding="utf-8")
    modules = [sys.modules[name] for name in sorted(sys.modules) if name[:4] == "ttr."]
    found = {it for one in modules for it in vars(one).values() if isinstance(it, Hook)}
    assert found <= set(declared.values())
    assert len(declared) <= 13


def test_an_operation_that_nobody_provides():
    @hook
    def bark(how_loud: int) -> str:
        raise AssertionError

    with pytest.raises(NotImplementedError, match=r"nothing provides .*bark"):
        bark(3)


def test_little_is_loaded_until_it_is_asked_for():
    text = "import sys, ttr\nprint(len([it for it in sys.modules if it[:4] == 'ttr.']))"
    text += "\nfrom ttr import Ind; print('ttr.judging' in sys.modules, Ind <= Ind)"
    run = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True)
    count, rest = run.stdout.split("\n", 1)
    assert int(count) < 5
    assert rest == "False True\n"


FORMER = [
    (module, former, now)
    for module, names in FORMER_NAMES.items()
    for former, now in names.items()
]


@pytest.mark.parametrize(("module", "former", "now"), FORMER)
def test_a_former_name_works_and_warns(module, former, now):
    now = now if ":" in now else f"{module}:{now}"
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        assert getattr(import_module(module), former) == resolve_name(now)
    was = f"{module}.{former}"
    told = [] if was in NEVER_WARN else [f"{was} is now {now.replace(':', '.')}"]
    assert [str(it.message) for it in said] == told
    assert all(it.filename == __file__ for it in said)


def test_a_name_that_never_was_is_not_found_in_a_module_with_former_names():
    with pytest.raises(AttributeError, match="has no attribute 'nonesuch'"):
        former_names("ttr.errors")("nonesuch")
    with pytest.raises(ImportError, match="cannot import name 'nonesuch'"):
        exec("from ttr.errors import nonesuch")
