"""What nobody foresaw is one line too, with a file for those who mend it."""

from __future__ import annotations

import stat
from collections.abc import Callable
from pathlib import Path

import pytest

import kille.interfaces.cli as kille_cli
import ttr.cli.main as ttr_cli
from ttr.safety.unforeseen_errors import DEBUG, report_unforeseen, run_guarded

MAINS: dict[str, tuple[object, Callable[[list[str]], int]]] = {
    "ttr": (ttr_cli, ttr_cli.main),
    "kille": (kille_cli, kille_cli.main),
}

ERRORS = {
    ValueError("wrong\nvalue"): "ValueError: wrong value: that is a mistake in ",
    KeyError(): "KeyError: that is a mistake in ",
    UnicodeDecodeError("utf-8", b"\xff", 0, 1, "odd"): "UnicodeDecodeError: 'utf-8'",
    OverflowError("\x1b[2J" + "x" * 999): r"OverflowError: \x1b[2Jxxx",
    OSError(5, "Input/output error"): "OSError: [Errno 5] Input/output error",
    MemoryError(): "there is not enough memory for this",
}


@pytest.fixture(autouse=True)
def state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.delenv(DEBUG, raising=False)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    return tmp_path / "kille" / "last-error.txt"


@pytest.mark.parametrize("program", MAINS)
@pytest.mark.parametrize(("error", "told"), ERRORS.items(), ids=repr)
def test_an_error_is_one_line_and_is_kept(
    program: str,
    error: Exception,
    told: str,
    state: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    module, main = MAINS[program]

    def fail(argv: object) -> int:
        raise error

    monkeypatch.setattr(module, "_run", fail)
    assert main([]) == 2
    out, complaint = capsys.readouterr()
    assert not out
    assert complaint.startswith(f"{program}: {told}")
    assert complaint.endswith(
        f"please report it to the developers of Kille, with the file {state}\n"
    )
    assert complaint.count("\n") == 1
    assert len(complaint) < 400
    assert "\x1b" not in complaint
    kept = state.read_text("utf-8")
    assert "raise error" in kept
    assert type(error).__name__ in kept
    assert stat.S_IMODE(state.stat().st_mode) == 0o600
    assert [it.name for it in state.parent.iterdir()] == [state.name]


def test_the_traceback_is_shown_to_who_asks(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(DEBUG, "1")
    report_unforeseen("ttr", ValueError("odd"))
    assert capsys.readouterr().err.startswith("ValueError: odd\nttr: ValueError: odd")


def test_the_traceback_is_kept_where_there_is_no_home(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "file"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    report_unforeseen("ttr", ValueError("odd"))
    [kept] = tmp_path.glob("kille-error-*.txt")
    assert str(kept) in capsys.readouterr().err
    assert stat.S_IMODE(kept.stat().st_mode) == 0o600


@pytest.mark.parametrize("wanted", [KeyboardInterrupt, SystemExit])
def test_who_wants_to_end_is_not_kept(wanted: type[BaseException]) -> None:
    def end() -> int:
        raise wanted

    with pytest.raises(wanted):
        run_guarded("ttr", end)
