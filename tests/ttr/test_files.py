"""Files are written in full or not at all, and never over what was read."""

import os
from pathlib import Path

import pytest

from ttr import TTRError
from ttr.cli.main import main
from ttr.safety.files import check_outputs, write_whole

DOOR = Path(__file__).parents[1] / "games" / "door.dlg"


def test_a_link_goes_on_leading_where_it_leads(tmp_path):
    (tmp_path / "kept.txt").write_text("old")
    link = tmp_path / "link.txt"
    link.symlink_to(tmp_path / "kept.txt")
    write_whole(link, "new")
    assert link.is_symlink()
    assert (tmp_path / "kept.txt").read_text() == "new"


def test_a_pipe_is_written_to_and_stays_one(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reading = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    write_whole(pipe, "whole")
    assert os.read(reading, 100) == b"whole"
    os.close(reading)
    assert pipe.is_fifo()


def test_half_a_character_is_no_reason_to_fail(tmp_path):
    write_whole(tmp_path / "a.txt", "a\ud800b")
    assert (tmp_path / "a.txt").read_text() == "a?b"


def test_a_draft_does_not_stay(tmp_path, monkeypatch):
    def interrupted(self, data):
        self.touch()
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "write_bytes", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_whole(tmp_path / "a.txt", "whole")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_is_no_file(tmp_path):
    with pytest.raises(TTRError, match="cannot be written: is a folder"):
        write_whole(tmp_path, "whole")


def test_two_outputs_are_two_files(tmp_path):
    a = tmp_path / "a"
    with pytest.raises(TTRError, match="would be written over: name another file"):
        check_outputs([], [a, tmp_path / "b" / ".." / "a"])
    check_outputs([], [Path(os.devnull), Path(os.devnull)])


@pytest.mark.parametrize("option", ["--log", "--html", "--junit"])
def test_a_story_is_not_written_over(tmp_path, option, capsys):
    story = tmp_path / "door.dlg"
    story.write_bytes(DOOR.read_bytes())
    assert main(["play", str(story), option, str(story)]) == 2
    assert capsys.readouterr().err == (
        f"ttr: {story} would be written over: name another file\n"
    )
    assert story.read_bytes() == DOOR.read_bytes()


def test_a_log_stays_where_no_dialogue_begins(tmp_path, capsys):
    log, story = tmp_path / "talk.jsonl", tmp_path / "no.dlg"
    log.write_text("kept")
    story.write_text("@ game nowhere.ttr talk\nU> [x : Ind]\n")
    assert main(["play", str(story), "--log", str(log)]) == 1
    capsys.readouterr()
    assert log.read_text() == "kept"


def test_links_that_lead_nowhere_are_told_of(tmp_path: Path) -> None:
    loop = tmp_path / "loop"
    loop.symlink_to(loop)
    check_outputs([loop], [tmp_path / "a"])
    with pytest.raises(TTRError, match="loop would be written over"):
        check_outputs([loop], [loop])
    with pytest.raises(TTRError, match="loop cannot be written: too many levels"):
        write_whole(loop, "whole")
    assert loop.is_symlink()
