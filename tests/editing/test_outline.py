"""What an editor is told of the names in a text."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from ttr.editing.outline import comment_above, declarations


@pytest.mark.parametrize(
    ("text", "comment"),
    [
        ("# One.\n# Two.\nbasic A", "One.\nTwo."),
        ("# Far.\n\n# Near.\n  basic A", "Near."),
        ("# ------\n# One.\n# ======\nbasic A", "One."),
        ("# Far.\n\nbasic A", ""),
        ("object b : B  # of b\nbasic A", ""),
        ("basic A", ""),
    ],
)
def test_the_comment_right_above_a_statement_is_about_it(
    text: str, comment: str
) -> None:
    assert declarations(text)[-1].comment == comment


def test_each_line_of_comments_is_read_once() -> None:
    """They were read again from each line on, in a time that grew with the square."""
    read = []

    def lines() -> Iterator[str]:
        for line in ["# near"] * 5 + [""] + ["# far"] * 1000:
            read.append(line)
            yield line

    assert comment_above(lines()) == "\n".join(["near"] * 5)
    assert len(read) == 6
    text = "# far\n" * 100_000 + "\nbasic A"
    assert declarations(text)[0].comment == ""
