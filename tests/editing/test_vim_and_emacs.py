"""What Vim and Emacs colour by, as they do it themselves, where they are installed."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Mapping
from pathlib import Path

import pytest

from ttr.cli.main import main
from ttr.editing.tokens import Kind, theory_tokens

VIM_PROBE = """
set nocompatible encoding=utf-8
syntax enable
syntax clear
unlet! b:current_syntax
source {syntax}
let out = []
for l in range(1, line('$'))
  for c in range(1, strlen(getline(l)))
    call add(out, l . ' ' . c . ' ' . synIDattr(synID(l, c, 0), 'name'))
  endfor
endfor
call writefile(out, '{found}')
qa!
"""

THEORY = """
basic Ind  # "things"
object guest, robot : Ind
pred ask(Ind, Ind), hears(Ind)
Ask   := [spkr = guest : Ind, e : ask(spkr, 'of # it')]
Board := [qud : list(Ind), of : Ind, p : Ind]
ask(x, y) <: hears(x) if x : Ind
given s1 : ask(guest, robot) in [0.25, 1]
check not [x : Ind] <= Ask
check [x : Ind] <= [y : Ind] up to relabelling
rule asked(s : Board, e : Ask) "What is asked." of integrate
    where [it = e.spkr : Ind]
    := [qud = [it] + s.qud : list(Ind)]
game talk({qud = []} : Board, acts on qud, hears Ask) := repeat(asked, 10)
"""

Kinds = dict[tuple[int, int], Kind]

LIKE = {
    "ttrKeyword": Kind.KEYWORD,
    "ttrString": Kind.STRING,
    "ttrNumber": Kind.NUMBER,
    "ttrComment": Kind.COMMENT,
}


def test_vim_tells_keywords_strings_numbers_and_comments(tmp_path: Path) -> None:
    syntax, theory = tmp_path / "ttr.vim", tmp_path / "a.ttr"
    assert main(["editor", "vim", str(syntax)]) == 0
    vim = shutil.which("vim") or shutil.which("nvim")
    if vim is None:
        pytest.skip("needs Vim (apt install vim)")
    theory.write_text(THEORY)
    (tmp_path / "probe.vim").write_text(
        VIM_PROBE.format(syntax=syntax, found=tmp_path / "found")
    )
    subprocess.run(
        [vim, "-N", "-u", "NONE", "-es", "-S", tmp_path / "probe.vim", theory],
        stdin=subprocess.DEVNULL,
        timeout=60,
        check=False,
    )
    assert read_colours(tmp_path / "found", LIKE) == expected_kinds(*LIKE.values())


def expected_kinds(*kinds: Kind) -> Kinds:
    """The kind of each letter of the theory that is of one of these kinds."""
    return {
        (THEORY.count("\n", 0, at) + 1, at - THEORY.rfind("\n", 0, at)): one.kind
        for one in theory_tokens(THEORY)
        for at in range(one.start, one.end)
        if one.kind in kinds and not THEORY[at].isspace()
    }


def read_colours(file: Path, names: Mapping[str, Kind]) -> Kinds:
    """What an editor wrote: line, column and its name of the kind, for each letter."""
    lines = THEORY.split("\n")
    found = {}
    for told in file.read_text().splitlines():
        line, column, *name = told.split(" ")
        place = int(line), int(column)
        kind = names.get(name[0] if name else "")
        if kind is not None and not lines[place[0] - 1][place[1] - 1].isspace():
            found[place] = kind
    return found


# --- Emacs ---------------------------------------------------------------------------

EMACS_PROBE = """
(load {mode} nil t)
(find-file {theory})
(font-lock-mode 1)
(font-lock-ensure)
(goto-char (point-min))
(let (found)
  (while (not (eobp))
    (unless (eolp)
      (push (format "%d %d %s" (line-number-at-pos) (1+ (current-column))
                    (or (get-text-property (point) 'face) ""))
            found))
    (forward-char))
  (let ((lines (mapconcat #'identity (nreverse found) "\\n")))
    (with-temp-file {found} (insert lines))))
"""

FACES = {
    "font-lock-keyword-face": Kind.KEYWORD,
    "font-lock-string-face": Kind.STRING,
    "font-lock-constant-face": Kind.NUMBER,
    "font-lock-comment-face": Kind.COMMENT,
    "font-lock-comment-delimiter-face": Kind.COMMENT,
}


def in_emacs(folder: Path, theory: Path) -> Path:
    """What Emacs colours, written into a file; skips the test where there is none."""
    mode, probe, found = (folder / it for it in ("ttr-mode.el", "probe.el", "found"))
    assert main(["editor", "emacs", str(mode)]) == 0
    emacs = shutil.which("emacs")
    if emacs is None:
        pytest.skip("needs Emacs (apt install emacs-nox)")
    files = {"mode": mode, "theory": theory, "found": found}
    quoted = {name: json.dumps(str(file)) for name, file in files.items()}
    probe.write_text(EMACS_PROBE.format(**quoted))
    done = subprocess.run(
        [emacs, "-Q", "--batch", "-l", probe],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return found


def test_emacs_tells_keywords_strings_numbers_and_comments(tmp_path: Path) -> None:
    theory = tmp_path / "a.ttr"
    theory.write_text(THEORY)
    found = read_colours(in_emacs(tmp_path, theory), FACES)
    assert found == expected_kinds(*FACES.values())


def test_emacs_sees_no_string_in_the_talk_of_a_story(tmp_path: Path) -> None:
    story = tmp_path / "a.dlg"
    story.write_text("U> It's a \"cup. # heard\nS> OK.\n")
    faces = [it.split(" ") for it in in_emacs(tmp_path, story).read_text().splitlines()]
    first = {int(column): face for line, column, face in faces if line == "1"}
    assert {first[1], first[2]} == {"font-lock-keyword-face"}
    assert {first[n] for n in range(3, 16)} == {""}
    assert first[18] == "font-lock-comment-face"
