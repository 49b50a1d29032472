"""The site: every public name has a page, links lead somewhere, pages can be read."""

from __future__ import annotations

import doctest
import random
import re
import warnings
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

pytest.importorskip("sphinx", reason="Sphinx is not installed: kille[docs]")

from docutils import nodes
from docutils.utils import new_document

import kille
import ttr
from browsers import IN_BROWSER
from tools.playground.links import text_of_fragment
from tools.playground.pyodide import FetchError
from tools.website.__main__ import MOST_BYTES, add_playground, build, size_of
from tools.website.api_pages import api_pages, page_of
from tools.website.bibliography import cited_as
from tools.website.docstrings import docstring_as_myst
from tools.website.html_check import compact, lost_links
from tools.website.playground_links import HAS_PLAYGROUND, add_playground_links
from tools.website.public_names import (
    ROOT,
    PublicName,
    names_without_example,
    public_names,
    public_rooms,
)
from tools.website.signatures import signature_of
from tools.website.source_pages import file_page
from ttr.probability import Chance


def test_every_public_name_has_a_page_and_every_room_an_index() -> None:
    pages = api_pages()
    for room in public_rooms().values():
        index = pages[f"api/{room.name}"]
        for name in room.names:
            assert name.name in pages[page_of(name)]
            assert f"/{page_of(name)}.md" in index
    every = {name for it in public_rooms().values() for name in it.names}
    assert {it.name for it in public_rooms()["ttr"].names} == set(ttr.__all__)
    assert {it.name for it in public_rooms()["kille"].names} == set(kille.__all__)
    assert {page_of(it).lower() for it in every} <= {it.lower() for it in pages}
    assert len({it.lower() for it in pages}) == len(pages), "some disks know no case"


def test_every_public_name_has_an_example() -> None:
    assert names_without_example() == []


VALUES = [it for it in public_names().values() if it.kind == "data"]


@pytest.mark.parametrize("value", VALUES, ids=lambda it: it.path)
def test_the_example_of_a_value_is_true(value: PublicName) -> None:
    """Those of functions and classes run with all doctests."""
    test = doctest.DocTestParser().get_doctest(value.doc, {}, value.path, None, 0)
    flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    assert doctest.DocTestRunner(optionflags=flags).run(test).failed == 0


def test_the_signature_of_a_named_tuple_has_types_as_they_are_written() -> None:
    written = signature_of(Chance, "ttr.probability.event_probability")
    assert [it.type for it in written.parameters][:2] == ["Degree", "bool"]


def test_a_docstring_keeps_its_formulas_and_examples() -> None:
    written = docstring_as_myst("p_o of [x : Ind] is `a_b`.\n\n- one\n\n>>> 1\n1")
    assert r"p\_o of \[x : Ind\] is `a_b`." in written
    assert "- one" in written
    assert written.endswith("```pycon\n>>> 1\n1\n```")


def test_a_link_that_leads_nowhere_is_found(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text('<a href="b.html#x">b</a><h1 id="top">a</h1>')
    (tmp_path / "b.html").write_text('<p id="x"><a href="a.html#y"></a><img src="c">')
    assert lost_links(tmp_path) == {"b.html": ["a.html#y", "c"]}


def test_a_place_can_be_named_without_quotes(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text('<b id=L7>x</b><a href="#L7"></a><a href="#L8">')
    assert lost_links(tmp_path) == {"a.html": ["#L8"]}


def test_compact_pages_keep_their_code() -> None:
    page = "<ul>\n    <li>one</li>\n</ul><pre>  as\n  it is</pre>"
    assert compact(page) == "<ul>\n<li>one</li>\n</ul><pre>  as\n  it is</pre>"


def test_works_are_found_as_the_pages_cite_them() -> None:
    assert cited_as()["Dobnik and de Graaf 2017"] == "cite-dobnik2017"
    assert set(cited_as().values()) == set(map(cited_as().get, cited_works()))


def cited_works() -> list[str]:
    """What the pages and the code cite, as they do."""
    files = [*(ROOT / "docs").rglob("*.md")]
    files += [it for room in ("ttr", "kille") for it in (ROOT / room).rglob("*.py")]
    text = " ".join(" ".join(it.read_text("utf-8").split()) for it in files)
    return [said for said in cited_as() if said in text]


def test_the_citation_has_what_cff_asks_for() -> None:
    text = (ROOT / "CITATION.cff").read_text("utf-8")
    keys = dict(re.findall(r"^([a-z-]+):(.*)$", text, flags=re.M))
    assert {"cff-version", "message", "title", "authors"} <= keys.keys()
    assert keys["cff-version"].strip() == "1.2.0"
    project = (ROOT / "pyproject.toml").read_text("utf-8")
    assert f'version = "{keys["version"].strip()}"' in project
    assert f'license = "{keys["license"].strip()}"' in project


@pytest.mark.parametrize(
    ("language", "code", "opened"),
    [
        ("ttr", "basic Ind", ["basic Ind"]),
        ("ttr", "rule x", []),
        ("text", "basic Ind", []),
        ("pycon", '>>> T = ttr.Theory.parse("""\n...   basic A\n... """)', ["basic A"]),
        ("ipython3", "r = 'basic B'\nTheory.parse('basic A; ' + r)", []),
        (
            "ipython3",
            "r = 'basic B'\nTheory.parse('basic A\\n' + r)",
            ["basic A\nbasic B"],
        ),
        ("python", "Theory.parse(text)", []),
        ("python", "%magic Theory.parse('basic A')", []),
    ],
)
def test_a_block_that_is_a_theory_opens_in_the_playground(
    language: str, code: str, opened: list[str]
) -> None:
    block = nodes.literal_block(code, code, language=language)
    page = new_document("page")
    page += block
    app = SimpleNamespace(config={HAS_PLAYGROUND: True})
    add_playground_links(cast(Any, app), page, "how-to/page")
    links = "".join(it.astext() for it in page.findall(nodes.raw))
    found = re.findall(r'href="\.\./playground/index\.html#([^"]+)"', links)
    assert [text_of_fragment(it) for it in found] == opened


def test_the_link_of_a_notebook_stands_below_its_cell() -> None:
    block = nodes.literal_block("", "Theory.parse('basic A')", language="ipython3")
    cell = nodes.container("", block, classes=["cell_input"])
    page = new_document("page")
    page += nodes.container("", cell, nodes.paragraph("", "its answer"))
    app = SimpleNamespace(config={HAS_PLAYGROUND: True})
    add_playground_links(cast(Any, app), page, "page")
    assert [type(it) for it in page[0].children] == [
        nodes.container,
        nodes.raw,
        nodes.paragraph,
    ]


def test_without_a_playground_nothing_links_to_it() -> None:
    page = new_document("page")
    page += nodes.literal_block("basic A", "basic A", language="ttr")
    app = SimpleNamespace(config={HAS_PLAYGROUND: False})
    add_playground_links(cast(Any, app), page, "page")
    assert not list(page.findall(nodes.raw))
    kennel = Path("examples/kennel.ttr")
    assert "Open in the playground" not in file_page(kennel)
    assert "Open in the playground" in file_page(kennel, has_playground=True)


def test_without_pyodide_the_site_has_no_playground(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail(_: Path, documentation: str) -> None:
        raise FetchError(f"no network for {documentation}")

    monkeypatch.setattr("tools.website.__main__.build_playground", fail)
    (tmp_path / "playground").mkdir()
    assert not add_playground(tmp_path)
    assert not (tmp_path / "playground").exists()
    said = capsys.readouterr().err
    assert said == "The site has no playground: no network for ../index.html\n"


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The whole site, built without a warning and without a lost link."""
    folder = tmp_path_factory.mktemp("site")
    with warnings.catch_warnings():
        warnings.simplefilter("default")  # of what Sphinx itself does
        assert build(folder / "site", folder / "work") == 0
    return folder / "site"


@pytest.mark.deep
def test_the_whole_site_is_built_and_not_large(site: Path) -> None:
    assert 1_000_000 < size_of(site) <= MOST_BYTES


def random_pages(site: Path) -> list[Path]:
    every = sorted(site.rglob("*.html"))
    pages = [it for it in every if it.parent.name != "playground"]  # has to be served
    return [site / "index.html", *random.Random(26).sample(pages, 100)]


@pytest.mark.deep
def test_a_hundred_pages_fit_a_telephone(site: Path, chromium: Any) -> None:
    context = chromium.new_context(viewport={"width": 390, "height": 800})
    tab = context.new_page()
    said: list[str] = []
    tab.on("console", lambda it: said.append(it.text) if it.type == "error" else None)
    tab.on("pageerror", lambda it: said.append(str(it)))
    wide = []
    for page in random_pages(site):
        tab.goto(page.as_uri())
        if tab.evaluate("document.documentElement.scrollWidth") > 390:
            wide.append(page.name)
    context.close()
    assert (wide, said) == ([], [])


@pytest.mark.deep
def test_search_needs_no_server(site: Path, chromium: Any) -> None:
    with chromium.new_context() as context:
        tab, said = context.new_page(), list[str]()
        tab.on("console", lambda it: said.append(f"{it.type}: {it.text}"))
        tab.goto((site / "index.html").as_uri())
        tab.fill(".sidebar-search", "donkey")
        tab.press(".sidebar-search", "Enter")
        tab.wait_for_selector("#search-results li")
        found = tab.inner_text("#search-results")
    assert "A donkey pronoun is strong after every" in found
    assert [it for it in said if it.startswith("error")] == []


for mark in IN_BROWSER:
    test_a_hundred_pages_fit_a_telephone = mark(test_a_hundred_pages_fit_a_telephone)
    test_search_needs_no_server = mark(test_search_needs_no_server)
