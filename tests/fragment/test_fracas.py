"""`ttr fracas` on problem sets of the same format, with sentences of our own."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from ttr.cli.main import main
from ttr.semantics.fragment.fracas import UnreadableError, problems

PROBLEM = """
<problem id="{number}" fracas_answer="{answer}">
  {premises}
  <q> Is that so? </q>
  {hypothesis}
  <a> {answer} </a>
</problem>
"""


def written(path: Path, *some: tuple[int, str, str]) -> Path:
    """A problem set: number, answer, premises and hypothesis with / between them."""
    body = []
    for number, answer, text in some:
        *premises, hypothesis = text.split("/")
        body.append(
            PROBLEM.format(
                number=f"{number:03}",
                answer=answer,
                premises="\n".join(
                    f'<p idx="{i}">\n {it}\n</p>' for i, it in enumerate(premises, 1)
                ),
                hypothesis=f"<h> {hypothesis} </h>" if hypothesis else "",
            )
        )
    path.write_text(
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<!DOCTYPE fracas-problems SYSTEM "fracas-problems.dtd">\n'
        '<fracas-problems><comment class="section"> 1 QUANTIFIERS </comment>'
        f"{''.join(body)}</fracas-problems>"
    )
    return path


@pytest.fixture
def fine(tmp_path: Path) -> Path:
    return written(
        tmp_path / "fine.xml",
        (1, "yes", "Every vet sings./Kim is a vet./Kim sings."),
        (2, "no", "No vet sings./Some vet sings."),
        (3, "unknown", "Some vet sings./Every vet sings."),
        (4, "undef", "Few vets sing./There are vets who sing."),
        (5, "yes", "Every wug sings./Some wug sings."),
        (6, "yes", "Every vet sings./"),
        (81, "no", "Every vet sings./Kim is a vet./Kim sings."),
    )


def test_section_1_is_read_with_its_spaces_straightened(fine: Path) -> None:
    found = problems(fine)
    assert [it.number for it in found] == [1, 2, 3, 4, 5, 6]
    assert found[0].premises == ("Every vet sings.", "Kim is a vet.")
    assert (found[0].hypothesis, found[0].answer) == ("Kim sings.", "yes")


def test_a_line_for_each_problem_and_the_totals(
    fine: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["fracas", str(fine)]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "001  right: yes",
        "002  right: no",
        "003  right: unknown",
        "004  without a plain answer: unknown",
        "005  outside the fragment: the lexicon has no word 'wug'",
        "006  outside the fragment: the problem has no hypothesis",
        "6 problems: 3 right, 0 wrong, 2 outside the fragment, "
        "1 without a plain answer",
    ]


def test_a_wrong_answer_exits_with_1(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(tmp_path / "w.xml", (7, "no", "Every vet sings./Every vet sings."))
    assert main(["fracas", str(path)]) == 1
    assert capsys.readouterr().out.startswith("007  wrong: yes, expected no\n")


def test_machines_get_json(fine: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["fracas", "--json", str(fine)]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["totals"] == {"right": 3, "wrong": 0, "outside": 2, "open": 1}
    assert told["problems"][0] == {
        "id": 1,
        "outcome": "right",
        "expected": "yes",
        "found": "yes",
        "why": "nothing makes the premises true and it false",
    }
    assert told["problems"][4]["found"] is None


def test_a_lexicon_adds_words(
    fine: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = tmp_path / "words.ttr"
    words.write_text('basic Ind\npred wug(Ind)\nnouns := ["wug"]\n')
    assert main(["fracas", str(fine), "--lexicon", str(words)]) == 1
    assert "005  wrong: unknown, expected yes" in capsys.readouterr().out


BOMB = '<!DOCTYPE x [<!ENTITY a "aa"><!ENTITY b "&a;&a;">]><fracas-problems>&b;'
OUTER = '<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]><fracas-problems>&a;'


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (b"", "is no XML"),
        (b"once upon a time", "is no XML"),
        (b"<fracas-problems>", "is no XML"),
        (b"\x00\xff", "is no XML"),
        (b'<?xml version="1.0" encoding="nonsense"?><a/>', "is no XML"),
        (b"<problems/>", "expected <fracas-problems>, found <problems>"),
        (b"<fracas-problems/>", "has none of the problems 1 to 80"),
        (b'<fracas-problems><problem id="x"/></fracas-problems>', "id is no number"),
        (f"{BOMB}</fracas-problems>".encode(), "declares the entity a"),
        (f"{OUTER}</fracas-problems>".encode(), "declares the entity a"),
    ],
)
def test_what_is_no_problem_set_is_told_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: bytes, said: str
) -> None:
    path = tmp_path / "it.xml"
    path.write_bytes(text)
    with pytest.raises(UnreadableError):
        problems(path)
    assert main(["fracas", str(path)]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("ttr: ")
    assert said in printed.err
    assert printed.err.count("\n") == 1


def test_a_file_that_is_not_there(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["fracas", str(tmp_path / "none.xml")]) == 2
    assert "there is no file" in capsys.readouterr().err
    assert main(["fracas", str(tmp_path)]) == 2
    assert "is a folder, not a file\n" in capsys.readouterr().err
