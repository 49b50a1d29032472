"""The theories that stand in pages: in blocks of notation, and in those of Python."""

from __future__ import annotations

import ast
import re
import textwrap
from collections.abc import Iterator, Mapping

from ttr.errors import TTRError
from ttr.theories.theory import Theory

_IMPORT = re.compile(r"^\s*import\b", re.MULTILINE)
_CELL = re.compile(r"^```\{code-cell\}[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)
_FILE = re.compile(r"^```ttr\b[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)
_PROMPT = re.compile(r"^(?:>>>|\.\.\.) ?(.*)$", re.MULTILINE)


def opens_alone(text: str) -> bool:
    """Whether a text is a theory without mistakes that needs no other file.

    >>> opens_alone("basic Ind"), opens_alone("basic"), opens_alone("import 'a.ttr'")
    (True, False, False)
    """
    if not text.strip() or needs_files(text):
        return False
    try:
        Theory.parse(text)
    except TTRError:
        return False
    return True


def needs_files(text: str) -> bool:
    """Whether a theory imports others, which are not there in a browser."""
    return bool(_IMPORT.search(text))


def theories_in_python(code: str) -> tuple[str, ...]:
    """The theories that a block of Python parses, as they are in a file.

    The block may be a dialogue with prompts. Texts may be put together by `+`, of
    strings and of variables that the block binds to strings.

    >>> theories_in_python('>>> A = "basic A"\\n>>> T = Theory.parse(A + ", B")')
    ('basic A, B',)
    """
    if "Theory.parse(" not in code:
        return ()
    if ">>> " in code:
        code = "\n".join(_PROMPT.findall(code))
    try:
        tree = ast.parse(code)
    except SyntaxError:
        return ()
    bound = {
        target.id: it.value.value
        for it in ast.walk(tree)
        if isinstance(it, ast.Assign) and isinstance(it.value, ast.Constant)
        for target in it.targets
        if isinstance(target, ast.Name) and isinstance(it.value.value, str)
    }
    texts = (
        textwrap.dedent(it).strip("\n").rstrip() for it in _theory_texts(tree, bound)
    )
    return tuple(dict.fromkeys(it for it in texts if opens_alone(it)))


def theories_in_notebook(page: str) -> tuple[str, ...]:
    """The theories of a notebook that open: its files, or else what its cells parse.

    >>> theories_in_notebook("```{code-cell}\\nTheory.parse('basic A')\\n```")
    ('basic A',)
    """
    files = tuple(it.rstrip() for it in _FILE.findall(page) if opens_alone(it))
    cells = (it for cell in _CELL.findall(page) for it in theories_in_python(cell))
    return files or tuple(cells)


def _theory_texts(tree: ast.AST, bound: Mapping[str, str]) -> Iterator[str]:
    """The texts that are given to `Theory.parse`, as far as they can be told."""
    for it in ast.walk(tree):
        match it:
            case ast.Call(func=ast.Attribute(attr="parse", value=where), args=[said]):
                if ast.unparse(where).split(".")[-1] == "Theory":
                    text = _text_of(said, bound)
                    if text is not None:
                        yield text


def _text_of(said: ast.expr, bound: Mapping[str, str]) -> str | None:
    match said:
        case ast.Constant(value=str(text)):
            return text
        case ast.Name(id=name):
            return bound.get(name)
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            parts = _text_of(left, bound), _text_of(right, bound)
            return None if None in parts else "".join(filter(None, parts))
    return None
