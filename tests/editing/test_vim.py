"""The syntax for Vim, as Vim itself colours by it, where there is one."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from ttr.cli.main import main
from ttr.editing.tokens import Kind, theory_tokens

PROBE = """
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
        PROBE.format(syntax=syntax, found=tmp_path / "found")
    )
    subprocess.run(
        [vim, "-N", "-u", "NONE", "-es", "-S", tmp_path / "probe.vim", theory],
        stdin=subprocess.DEVNULL,
        timeout=60,
        check=False,
    )
    expected = {
        (THEORY.count("\n", 0, at) + 1, at - THEORY.rfind("\n", 0, at)): one.kind
        for one in theory_tokens(THEORY)
        for at in range(one.start, one.end)
        if one.kind in LIKE.values() and not THEORY[at].isspace()
    }
    lines = THEORY.split("\n")
    found = {}
    for told in (tmp_path / "found").read_text().splitlines():
        line, column, *name = told.split(" ")
        place = int(line), int(column)
        kind = LIKE.get(name[0] if name else "")
        if kind is not None and not lines[place[0] - 1][place[1] - 1].isspace():
            found[place] = kind
    assert found == expected
