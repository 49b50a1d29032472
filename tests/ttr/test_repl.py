"""Sessions of `ttr repl`: what is said to what is typed, piped and at a terminal."""

from __future__ import annotations

import os
import pty
import re
import select
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import ttr
from ttr.cli.session.completion import completions
from ttr.cli.session.repl import COMMANDS, Pending, is_complete, respond
from ttr.cli.session.sessions import Session

ROOT = Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "docs" / "how-to" / "try-things-out.md"
REPL = [sys.executable, "-m", "ttr.cli.main", "repl"]

KENNEL = """\
basic Ind
pred dog(Ind), hug(Ind, Ind)
object fido, sam : Ind
given s1 : dog(fido)
Dog := [x : Ind, c : dog(x)]
Pair := [a : Dog, b : Dog]
"""


def after(text: str, session: Session | None = None) -> Session:
    """The session after lines that must all be taken."""
    session = session or Session()
    for line in text.splitlines():
        reply = respond(session, line)
        assert not reply.text.startswith("error"), reply.text
        session = reply.session
    return session


@pytest.fixture
def kennel() -> Session:
    return after(KENNEL)


# --- replies -------------------------------------------------------------------------

REPLIES = {
    "": "",
    "# only a comment": "",
    "Dog": "[x : Ind, c : dog(x)]",
    "fido": "fido",
    "[fido] + [sam]": "[fido, sam]",
    r"(\x:Ind. dog(x))(fido)": "dog(fido)",
    "{x = fido, c = s1} : Dog": "yes: field by field",
    "{x = sam, c = s1} : Dog": (
        "no: c: s1 : dog(sam) (nothing says so; s1 is of dog(fido))"
    ),
    "s1 : dog(fido)": "yes: given",
    r"s1 : (\x:Ind. dog(x))(fido)": "yes: given",
    "fido : dog(fido)": "no: nothing says so; fido is of Ind; s1 would do",
    "Dog <= [x : Ind]": "yes: each field of [x : Ind] is there, and below",
    "[x : Ind] <= Dog": "no: [x : Ind] has no field c\ncounter-example: {x = a1}",
    "Dog = [c : dog(x), x : Ind]": "yes",
    "Dog = Pair": (
        "no: [x : Ind, c : dog(x)] is not "
        "[a : [x : Ind, c : dog(x)], b : [x : Ind, c : dog(x)]]"
    ),
    "merge(Dog, [y : Ind])": "[x : Ind, y : Ind, c : dog(x)]",
    "amerge(Dog, [c : Ind])": "[c : Ind, x : Ind]",
    "merge(Dog, [x : Ind]) = Dog": "yes",
    "merge(Dog, [x : Ind]) = [x : Ind]": "no: [x : Ind, c : dog(x)]",
    "wellformed(Dog)": "yes",
    "wellformed([c : dog(x.y), x : Ind])": (
        "no: the path x.y leads nowhere: Ind is no record type"
    ),
    "wellformed([a = b : Ind, b = a : Ind])": (
        "no: its paths go in a circle: a → b → a"
    ),
    "create(Dog)": "{c = s2, x = a1}",
    "witnesses(Dog)": "{c = s1, x = fido}",
    "witnesses(hug(fido, sam))": "none is known",
    "witnesses(Ind)": "fido\nsam",
    "P(s1 : dog(fido)) = 1": "yes",
    "P(s1 : dog(fido)) = 0.5": "no: p = 1",
    "check Dog <= [x : Ind]": "it holds",
    "basic Image": "",
    ":undo": "undone",
    ":latex Ind": r"\mathit{Ind}",
    ":box Dog": "⎡x : Ind   ⎤\n⎣c : dog(x)⎦",
}


@pytest.mark.parametrize("typed", REPLIES)
def test_what_is_typed_gets_its_reply(kennel: Session, typed: str) -> None:
    said = respond(kennel, typed).text
    assert re.sub(r" +", " ", said) == re.sub(r" +", " ", REPLIES[typed])


def test_a_degree_is_told_and_what_is_open_is_unknown(kennel: Session) -> None:
    seen = after("given s3 : dog(sam) = 0.7\nopen hug", kennel)
    assert respond(seen, "s3 : dog(sam)").text == "p = 0.7: given"
    said = respond(seen, "s3 : hug(sam, sam)").text
    assert said == "unknown: nothing is known of it"


MISTAKES = {
    "[x : Idn]": ("nothing is called Idn here", 6, "did you mean Ind?"),
    "Idn <= Dog": ("nothing is called Idn here", 1, "did you mean Ind?"),
    "{x = fido, c = Idn.y} : Dog": ("nothing is called Idn here", 16, "Ind?"),
    "Dog <= ": ("expected a type, found the end of the text", 7, ""),
    "Dog dog": ("expected :, =, <= or the end, found dog", 5, ""),
    "basic ind Foo": ("expected a comma or the end, found Foo", 11, ""),
    "[x : Ind))": ("expected a comma or ], found )", 9, ""),
    "given s1 : Dgo": ("nothing is called Dgo here", 12, "did you mean Dog?"),
    "merge(Dog)": ("merge takes two types, but has 1", 1, ""),
    "create(Dog, Dog)": ("create takes one type, but has 2", 1, ""),
    "create(fido)": ("expected a type, found the object fido", 8, ""),
    "not Dog <= Dog": ("a question is asked as it is", 1, "word check"),
    'import "none.ttr"': ("there is no file", 1, ""),
    "Dog := [x : Idn]": ("nothing is called Idn here", 13, "did you mean Ind?"),
    "\x00": ("the control character '\\x00' is no notation", 1, ""),
    "Cat = [x : Ind]": ("nothing is called Cat here", 1, "written Name := T"),
    "Dgo = [x : Ind]": ("nothing is called Dgo here", 1, "mean Dog? a definition is"),
    "[" * 200: ("types and objects nest at most 100 deep", 101, ""),
}


@pytest.mark.parametrize("typed", MISTAKES)
def test_a_mistake_is_underlined_and_changes_nothing(
    kennel: Session, typed: str
) -> None:
    message, column, hint = MISTAKES[typed]
    reply = respond(kennel, typed)
    assert reply.session is kennel
    assert reply.text.startswith(f"error: {message}")
    assert f"<input>:1:{column}\n" in reply.text
    assert hint in reply.text.partition("help: ")[2] or not hint


def test_what_rests_on_a_name_says_why_it_cannot_change(kennel: Session) -> None:
    said = respond(kennel, "Ind := 3").text
    assert said.startswith("error: Ind cannot change so: expected a type, found Ind")


@pytest.mark.parametrize("name", ["exit", "help"])
def test_a_name_that_is_declared_is_no_slip_for_a_command(name: str) -> None:
    session = after(f"basic Ind\nobject {name} : Ind")
    assert respond(session, name).text == name


def test_a_hint_for_python_is_not_given_in_a_session(kennel: Session) -> None:
    assert "help" not in respond(kennel, "\x07").text


def test_a_mistake_in_a_later_line_is_underlined_there(kennel: Session) -> None:
    said = respond(kennel, "[x : Ind,\n  c : dgo(x)] <= Dog").text
    assert "<input>:2:7\n2 │   c : dgo(x)] <= Dog\n  │       ^^^" in said


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        (r"(\x:Ind. dog(x))('nobody')", "takes objects of Ind, which nobody is not"),
        ("create(Ind@fido /\\ Ind@sam)", "fido"),
        ("witnesses(list(Ind))", "cannot be listed"),
        (":bx", "there is no command :bx\nhelp: did you mean :box?"),
        (":wyh", "there is no command :wyh\nhelp: did you mean :why?"),
        ("exit", "exit is no command here\nhelp: :help lists the commands, :quit ends"),
        ("?", "? is no command here\nhelp: :help lists the commands, :quit ends"),
        ("create([x = y : Ind, y = x : Ind])", "go in a circle: x → y → x"),
        (":", "there is no command :"),
        (":quit now", ":quit stands alone, found now"),
        (":load", ":load needs a file"),
        (":load none.ttr", "there is no file none.ttr"),
        (":save none/of/these.ttr", "cannot be written: no such file or directory"),
        (":box Dgo", "did you mean Dog?"),
        (":box", "there is nothing to draw"),
        (":why", "there is no answer to explain"),
    ],
)
def test_other_mistakes_are_told_too(kennel: Session, typed: str, said: str) -> None:
    reply = respond(kennel, typed)
    assert reply.session is kennel
    assert reply.text.startswith("error: ")
    assert said in reply.text


@pytest.mark.parametrize(
    "typed", [":save LOOP", ":load LOOP", 'import "LOOP"', ":save a\0", ":load a\0"]
)
def test_what_is_no_path_of_a_file_is_told(
    kennel: Session, tmp_path: Path, typed: str
) -> None:
    loop = tmp_path / "loop"
    loop.symlink_to(loop)
    reply = respond(kennel, typed.replace("LOOP", str(loop)))
    assert reply.session is kennel
    assert reply.text.startswith("error: ")


def test_a_name_declared_by_the_theory_hides_a_question() -> None:
    session = after("basic Ind\npred create(Ind)\nobject a : Ind")
    assert respond(session, "create(a)").text == "create(a)"


def test_a_check_that_fails_is_told_and_not_kept(kennel: Session) -> None:
    reply = respond(kennel, "check not Dog <= [x : Ind]")
    assert "expected: no\nfound:    yes" in reply.text
    assert reply.session is kennel


def test_why_shows_the_derivation_of_the_last_answer(kennel: Session) -> None:
    asked = respond(kennel, "{x = sam, c = s1} : Dog").session
    assert "✗ c: s1 : dog(sam)" in respond(asked, ":why").text
    assert "⎤ : ⎡" in respond(asked, ":box").text
    asked = respond(kennel, "[x : Ind] <= Dog").session
    assert "✗ c: nothing : dog(a1)" in respond(asked, ":why").text
    asked = respond(kennel, "create(Dog)").session
    assert "✓ c: s2 : dog(a1)" in respond(asked, ":why").text


def test_help_names_every_command(kennel: Session) -> None:
    said = respond(kennel, ":help").text
    assert all(f":{name}" in said for name in COMMANDS)
    assert max(map(len, said.splitlines())) <= 80


def test_names_lists_what_is_declared(kennel: Session) -> None:
    assert respond(kennel, ":names").text.splitlines() == [
        "basic   Ind",
        "pred    dog(Ind), hug(Ind, Ind)",
        "object  fido, s1, sam",
        "defined Dog, Pair",
    ]
    assert respond(Session(), ":names").text == "no name is declared"


# --- a session that grows ------------------------------------------------------------


def test_what_is_created_is_kept_with_its_names(kennel: Session) -> None:
    session = respond(kennel, "create(Pair)").session
    assert respond(session, "{x = a1, c = s2} : Dog").text == "yes: field by field"
    assert respond(session, "witnesses(Dog)").text.count("\n") == 2
    assert respond(session, ":undo").session is kennel


@pytest.mark.parametrize(
    "T",
    [
        "Ind",
        "Pair",
        "[x : Ind, s : dog(x) \\/ hug(x, x)]",
        "nelist(Dog)",
        "set(Ind)",
        "str(dog(fido), dog(sam))",
        "plus(dog(fido))",
        "[p : (Ind -> Type), x : Ind, c : p(x)]",
        "[x = fido : Ind, y : [z : hug(^.x, sam)]]",
        "[T : Type, x : Ind]",
    ],
)
def test_what_is_created_is_still_there_after_saving(
    kennel: Session, tmp_path: Path, T: str
) -> None:
    reply = respond(kennel, f"create({T})")
    assert not reply.text.startswith("error"), reply.text
    assert respond(reply.session, f"{reply.text} : {T}").text.startswith("yes")
    file = tmp_path / "kept.ttr"
    respond(reply.session, f":save {file}")
    again = after(f":load {file}")
    assert respond(again, f"{reply.text} : {T}").text.startswith("yes")


def test_what_is_created_by_what_it_is_not_is_kept_too(kennel: Session) -> None:
    reply = respond(kennel, "create(~Ind)")
    assert respond(reply.session, f"{reply.text} : ~Ind").text.startswith("yes")
    assert respond(reply.session, "create(Ind)").text != reply.text


def test_a_word_that_begins_no_statement_gets_a_suggestion(kennel: Session) -> None:
    assert "did you mean basic?" in respond(kennel, "bsic A").text


def test_what_is_underlined_is_what_was_typed(kennel: Session) -> None:
    _, _, line, carets, _ = respond(kennel, "not Ind <= Ind").text.splitlines()
    assert len(carets) == len(line)


def test_a_created_name_that_means_something_else_is_quoted() -> None:
    session = after("basic Ind\na1 := Ind\ncreate(Ind)")
    assert respond(session, "witnesses(Ind)").text == "a1"
    assert respond(session, "'a1' : Ind").text == "yes: given"
    assert respond(session, "a1").text == "Ind"


def test_what_rests_on_a_name_follows_when_it_is_redefined(kennel: Session) -> None:
    reply = respond(kennel, "Dog := [x : Ind]")
    assert reply.text == "changed: Dog, Pair"
    assert respond(reply.session, "Pair").text == "[a : [x : Ind], b : [x : Ind]]"
    assert respond(reply.session, ":undo").session is kennel


def test_a_new_meaning_may_rest_on_what_came_later(kennel: Session) -> None:
    later = after("basic Cat\nDog := [x : Cat]", kennel)
    assert respond(later, "Pair").text == "[a : [x : Cat], b : [x : Cat]]"


def test_a_name_may_become_another_kind_of_name(kennel: Session) -> None:
    session = after("fido := {x = sam}\nsam : Ind", kennel)
    assert respond(session, "fido.x").text == "sam"


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("Dog := [d : Dog]", "Dog would rest on itself"),
        ("Dog := [p : Pair]", "Dog would rest on Pair, which rests on Dog"),
        ("pred dog(Ind, Ind)", "dog cannot change so: dog takes 2 arguments"),
        ("Ind := fido", "Ind would rest on fido, which rests on Ind"),
    ],
)
def test_a_name_that_cannot_change_so_stays(
    kennel: Session, typed: str, said: str
) -> None:
    reply = respond(kennel, typed)
    assert reply.session is kennel
    assert reply.text.startswith(f"error: {said}")


def test_one_name_of_a_list_is_redefined_alone(kennel: Session) -> None:
    session = after("sam := {x = fido}\npred hug(Ind)", kennel)
    assert respond(session, "fido : Ind").text == "yes: given"
    assert respond(session, "dog(fido)").text == "dog(fido)"
    assert respond(session, ":names").text.splitlines()[1:3] == [
        "pred    dog(Ind), hug(Ind)",
        "object  fido, s1",
    ]


def test_an_imported_name_is_not_redefined(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "kennel.ttr").write_text(KENNEL)
    session = after('import "kennel.ttr"')
    assert respond(session, "Dog := Ind").text.startswith("error: Dog is declared in ")
    session = after("Cats := list(Dog)", session)
    (tmp_path / "below").mkdir()
    respond(session, ":save below/saved.ttr")
    assert 'import "../kennel.ttr"' in (tmp_path / "below" / "saved.ttr").read_text()
    with pytest.raises(ttr.TTRError, match="--allow"):
        ttr.load("below/saved.ttr")
    found = ttr.load("below/saved.ttr", allow=["."])
    assert found.Cats is ttr.ListOf(session.theory.Dog)
    assert "Cats" in respond(session, ":load below/saved.ttr").session.theory.names


def test_a_fact_that_contradicts_is_refused(kennel: Session) -> None:
    facts = "pred puppy(Ind)\npuppy(x) <: dog(x)\ngiven s5 : dog(sam) = 0"
    session = after(facts, kennel)
    reply = respond(session, "given s5 : puppy(sam)")
    assert reply.session is session
    assert reply.text.startswith("error: ")
    assert "<input>:1:1\n" in reply.text
    reply = respond(session, "hug(x, y) <: dog(x)\n")
    assert respond(reply.session, "s5 : dog(sam)").text.startswith("no")


def test_an_axiom_takes_effect_at_once(kennel: Session) -> None:
    session = after("pred puppy(Ind)\ngiven s6 : puppy(sam)", kennel)
    assert respond(session, "s6 : dog(sam)").text.startswith("no")
    session = after("puppy(x) <: dog(x)", session)
    assert respond(session, "s6 : dog(sam)").text.startswith("yes")


def test_undo_goes_back_step_by_step() -> None:
    session = after("basic A\nbasic B\nA\nA <= B\nbasic C")
    names = []
    while session.before is not None:
        names.append("".join(sorted(session.theory.names)))
        session = respond(session, ":undo").session
    assert names == ["ABC", "AB", "A"]
    assert respond(session, ":undo").text == "error: there is nothing to undo"


@pytest.mark.parametrize("file", ["kennel", "functions", "gameboard", "collections"])
def test_a_theory_that_was_loaded_and_saved_is_the_same(
    tmp_path: Path, file: str
) -> None:
    path = ROOT / "tests" / "theories" / f"{file}.ttr"
    saved = tmp_path / "saved.ttr"
    respond(after(f":load {path}"), f":save {saved}")
    one, other = ttr.load(path), ttr.load(saved)
    assert one.definitions == other.definitions
    assert one.names == other.names
    assert [it.text for it in one.checks] == [it.text for it in other.checks]
    assert ttr.check(other).holds


def test_loading_a_changed_file_again_changes_the_session(tmp_path: Path) -> None:
    file = tmp_path / "kennel.ttr"
    file.write_text(KENNEL)
    session = after(f":load {file}\nCats := list(Dog)")
    file.write_text(KENNEL.replace("[x : Ind, c : dog(x)]", "[x : Ind]"))
    reply = respond(session, f":load {file}")
    assert reply.text.endswith("names\nchanged: Cats, Dog, Pair")
    assert respond(reply.session, "Cats").text == "list([x : Ind])"


SOUP = r"""
    basic pred object given check open not Ind A dog hug fido s1 Dog Pair x y . , ( )
    [ ] { } < > : = := <: <= -> /\ \/ ~ @ + .x ^.x \x:Ind. 'q' 0.5 Type list( str(
    create( merge( witnesses( :box :why :undo :names
"""
LINES = (
    "Dog := [x : Ind]",
    "Ind := Type",
    "Pair := Dog",
    "create(Pair)",
    "given s2 : dog(fido)",
    "pred dog(Type)",
    "dog(x) <: hug(x, x)",
    "fido := Dog",
    "Dog <= Pair",
    ":undo",
)
soup = st.lists(st.sampled_from(SOUP.split()), max_size=5).map(" ".join)


@given(st.lists(st.sampled_from(LINES) | soup, max_size=8))
def test_whatever_is_typed_the_session_is_sound(inputs: list[str]) -> None:
    session = after(KENNEL)
    for typed in inputs:
        reply = respond(session, typed)
        assert reply.session is session or not reply.text.startswith("error")
        session = reply.session
        assert completions(session, typed) is not None
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "saved.ttr")
        respond(session, f":save {file}")
        assert ttr.load(file).definitions == session.theory.definitions
        assert ttr.load(file).names == session.theory.names


# --- completion, and inputs of several lines -----------------------------------------


@pytest.mark.parametrize(
    ("before", "words"),
    [
        ("", ["Dog", "Ind", "Pair", "basic", "create", "fido", "list"]),
        ("[x : D", ["Dog"]),
        ("given s : do", ["dog"]),
        ("cre", ["create"]),
        (r"\whom:Ind. dog(wh", ["whom"]),
        ("[thing : Ind,\n  c : dog(th", ["thing"]),
        ("Pair.a", ["a"]),
        (":l", ["latex", "load"]),
        ("zzz", []),
    ],
)
def test_names_words_and_labels_are_completed(
    kennel: Session, before: str, words: list[str]
) -> None:
    found = completions(kennel, before)
    assert set(words) <= set(found)
    assert found == sorted(found)
    assert found == words or not before


def test_files_are_completed(tmp_path: Path) -> None:
    (tmp_path / "kennel.ttr").touch()
    (tmp_path / "kept").mkdir()
    (tmp_path / "kennel.txt").touch()
    found = completions(Session(), f":load {tmp_path}/ke")
    assert found == ["kennel.ttr", "kept/"]
    assert completions(Session(), f":load {tmp_path}/none/") == []


@pytest.mark.parametrize(
    ("text", "whole"),
    [
        ("Dog", True),
        ("[x : Ind,\n c : dog(x)]", True),
        ("[x : Ind", False),
        ("{x = fido", False),
        ("Dog :=", False),
        ("Dog <=", False),
        ("Dog /\\", False),
        ("~", False),
        (r"\x:Ind.", False),
        ("Dog := # [ a comment", False),
        ("Dog # [ a comment", True),
        ('"a [ quoted name"', True),
        ("given 'a\\'[' : Ind", True),
        ("[x : Ind))", True),
        (":", True),
        (":box [x : Ind,", False),
        ("<s1 s2>", True),
    ],
)
def test_an_input_goes_on_while_something_is_open(text: str, whole: bool) -> None:
    assert is_complete(text) == whole


# --- through a pipe ------------------------------------------------------------------


def piped(typed: str, *words: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [*REPL, *words],
        input=typed.encode(),
        capture_output=True,
        check=False,
        timeout=60,
        env={**os.environ, "PYTHONUTF8": "1"},
    )


def test_a_pipe_gets_answers_only_and_errors_do_not_end_it(tmp_path: Path) -> None:
    file = tmp_path / "kennel.ttr"
    file.write_text(KENNEL)
    done = piped("Dgo\nPuppy := [x : Ind,\n  c :\ndog(x)]\nPuppy = Dog\nPup", str(file))
    assert done.returncode == 0
    assert done.stderr == b""
    said = done.stdout.decode()
    assert said.startswith("error: nothing is called Dgo here\n")
    assert "\nyes\nerror: nothing is called Pup here" in said
    assert "ttr>" not in said


def test_quit_ends_a_pipe_and_odd_bytes_do_not() -> None:
    done = subprocess.run(
        REPL, input=b"\xff\xfe\n\x00\nType\n:quit\nType\n", capture_output=True
    )
    assert done.returncode == 0
    assert done.stderr == b""
    assert done.stdout.count(b"error: ") == 2
    assert done.stdout.count(b"\nType\n") == 1


def test_a_file_that_cannot_be_read_ends_it(tmp_path: Path) -> None:
    done = piped("Type\n", str(tmp_path / "none.ttr"))
    assert (done.returncode, done.stdout) == (2, b"")
    assert done.stderr.startswith(b"ttr: there is no file ")
    wrong = tmp_path / "wrong.ttr"
    wrong.write_text("Dog := [x : Ind]")
    done = piped("Type\n", str(wrong))
    assert (done.returncode, done.stderr) == (1, b"")
    assert done.stdout.startswith(b"error: nothing is called Ind here")


# --- at a terminal -------------------------------------------------------------------


class Terminal:
    """A terminal with `ttr repl` in it."""

    def __init__(self, state: Path) -> None:
        self.child, self.screen = pty.fork()
        if self.child == 0:
            surroundings = {**os.environ, "XDG_STATE_HOME": str(state), "TERM": "dumb"}
            os.execve(sys.executable, REPL, surroundings)

    def until(self, sign: str) -> str:
        """What is shown from now until the sign."""
        shown = b""
        end = time.monotonic() + 30
        while sign.encode() not in shown:
            ready, _, _ = select.select([self.screen], [], [], end - time.monotonic())
            assert ready, f"no {sign!r} in {shown!r}"
            shown += os.read(self.screen, 4096)
        return shown.decode()

    def type(self, keys: str, sign: str = "ttr> ") -> str:
        os.write(self.screen, keys.encode())
        return self.until(sign)

    def interrupt(self, sign: str = "ttr> ") -> None:
        """Presses Ctrl-C until the sign is shown.

        Python's readline misses it between the prompt and its waiting for a key.
        """
        shown = b""
        for _ in range(30):
            os.write(self.screen, b"\x03")
            while select.select([self.screen], [], [], 1)[0]:
                shown += os.read(self.screen, 4096)
                if sign.encode() in shown:
                    return
        raise AssertionError(f"Ctrl-C is not taken notice of: {shown!r}")

    def code(self) -> int:
        return os.waitstatus_to_exitcode(os.waitpid(self.child, 0)[1])


@pytest.fixture
def terminal(tmp_path: Path) -> Iterator[Terminal]:
    opened = Terminal(tmp_path)
    yield opened
    os.close(opened.screen)


def test_lines_at_a_terminal(terminal: Terminal, tmp_path: Path) -> None:
    pytest.importorskip("readline")
    terminal.until("ttr> ")
    terminal.type("basic Individual\r")
    terminal.type("Thing := [x : Indi\t,\r", "...> ")
    terminal.type("y : Individual]\r")
    assert "[x : Individual, y : Individual]\r\n" in terminal.type("Th\t\r")
    terminal.type("[x :\r", "...> ")
    terminal.interrupt()  # drops the line
    assert "error" not in terminal.type("Thing <= Thing\r")
    assert "error: nothing is called Thnig" in terminal.type("Thnig\r")
    os.write(terminal.screen, b"\x04")  # Ctrl-D ends
    assert terminal.code() == 0
    history = (tmp_path / "ttr" / "history").read_text(encoding="utf-8")
    assert "basic Individual\n" in history
    assert "Thing := [x : Individual,\n" in history


def test_a_history_that_cannot_be_kept_is_no_complaint(tmp_path: Path) -> None:
    (tmp_path / "ttr").write_text("a file where the folder should be")
    opened = Terminal(tmp_path)
    opened.until("ttr> ")
    os.write(opened.screen, b":quit\r")
    assert opened.code() == 0
    os.close(opened.screen)


# --- the page ------------------------------------------------------------------------


def sessions() -> list[str]:
    page = PAGE.read_text("utf-8")
    blocks = re.findall(r"^```text\n(ttr> .*?)^```", page, re.M | re.S)
    assert len(blocks) >= 3
    return blocks


def test_the_page_shows_what_happens(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    session, typed, shown = Session(), "", []
    for line in [*"".join(sessions()).splitlines(), "ttr> "]:
        if not line.startswith(("ttr> ", "...> ")):
            shown.append(line)
            continue
        if line.startswith("ttr> "):
            reply = respond(session, typed)
            assert reply.text.splitlines() == shown, typed
            session, typed, shown = reply.session, "", []
        typed = f"{typed}\n{line[5:]}".strip()


def test_each_line_of_a_long_input_is_looked_at_once() -> None:
    def seconds(lines: int) -> float:
        start = time.process_time()
        pending = Pending()
        for _ in range(lines):
            pending = pending.after("[x : Ind,")
        assert not pending.is_complete
        return time.process_time() - start

    seconds(100)
    assert seconds(8000) < 20 * seconds(1000)


@pytest.mark.parametrize(
    "text", ["[x :\nInd]", "Dog :=\n\n# a comment\n[", ":load a.\n", "a\n:", "\\\nx"]
)
def test_an_input_is_whole_whether_looked_at_by_line_or_at_once(text: str) -> None:
    pending = Pending()
    for line in text.split("\n"):
        pending = pending.after(line)
    assert pending.is_complete == is_complete(text)


def test_what_is_said_already_is_not_worked_out_again(monkeypatch):
    """A session that was piped in over and over took half a minute for 30 kB."""
    said = ["basic Ind", "pred run(Ind), fall(Ind)", "fall(x) <: run(x)"]
    said += ["Runner := [x : Ind, c : run(x)]"]
    session = Session()
    for line in said:
        session = respond(session, line).session
    assert len(session.entries) == 4

    def again(*_):
        raise AssertionError("the whole session is read again")

    monkeypatch.setattr("ttr.cli.session.sessions.theory_of_text", again)
    for line in said:
        reply = respond(session, line)
        assert reply.text == ""
        assert reply.session.entries == session.entries
        assert reply.session.theory is session.theory


def test_a_fact_is_said_again_and_a_name_changed_back():
    session = Session()
    for line in ["basic A, B", "T := A", "T := B", "T := A"]:
        session = respond(session, line).session
    assert str(session.theory.T) == "A"
    for line in ["object a : A", "given a : A", "given a : A"]:
        reply = respond(session, line)
        assert "error" not in reply.text
        session = reply.session


def test_normal_prints_what_a_type_computes_to() -> None:
    session = after("basic Ind\npred man(Ind)\nMan := \\v:Ind. [e : man(v)]")
    written = "[x : Ind, r : Man(x)]"
    assert respond(session, f":normal {written}").text == "[x : Ind, r : [e : man(x)]]"
    claim = f"{written} = [x : Ind, r : [e : man(^.x)]]"
    assert respond(session, claim).text.startswith("yes")
