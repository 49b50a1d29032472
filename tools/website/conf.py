"""How Sphinx builds the site; `python -m tools.website` composes what it reads."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from docutils import nodes
from pygments.lexers import TextLexer, find_lexer_class_by_name
from pygments.util import ClassNotFound
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx

from tools.website.api_pages import page_of
from tools.website.playground_links import HAS_PLAYGROUND, add_playground_links
from tools.website.public_names import known_paths, public_rooms

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
CACHE = ROOT / "build" / "website" / "notebooks"

project = "Kille"
author = "The Kille developers"
copyright = author
extensions = ["myst_nb", "sphinxcontrib.bibtex", "sphinx_copybutton"]
exclude_patterns: list[str] = []
nitpicky = False

myst_enable_extensions = ["attrs_inline", "deflist", "dollarmath"]
myst_heading_anchors = 6
myst_dmath_allow_labels = False
myst_dmath_double_inline = True

nb_execution_mode = os.environ.get("KILLE_NOTEBOOKS", "cache")
nb_execution_cache_path = str(CACHE)
nb_execution_timeout = 240
nb_execution_raise_on_error = True
nb_execution_show_tb = True
nb_merge_streams = True

bibtex_bibfiles = [str(ROOT / "docs" / "references.bib")]
bibtex_cite_id = "cite-{key}"

python_use_unqualified_type_names = True
python_maximum_signature_line_length = 76
add_module_names = True

copybutton_prompt_text = r">>> |\.\.\. |\$ |U> "
copybutton_prompt_is_regexp = True

html_theme = "furo"
html_title = "Kille"
html_static_path = [str(HERE / "static")]
templates_path = [str(HERE / "templates")]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_use_index = True
html_domain_indices = False
html_permalinks_icon = "#"
pygments_style = "tango"
pygments_dark_style = "github-dark"
suppress_warnings = ["myst.strikethrough", "mystnb.unknown_mime_type"]


def setup(app: Sphinx) -> dict[str, bool]:
    """Adds what the pages need of Sphinx and it does not have."""
    for name in ("ttr", "dlg"):
        try:
            find_lexer_class_by_name(name)
        except ClassNotFound:
            app.add_lexer(name, TextLexer)
    app.connect("doctree-read", leave_foreign_names)
    app.connect("html-page-context", add_ways)
    app.add_config_value(HAS_PLAYGROUND, False, "html", bool)
    app.connect("doctree-resolved", add_playground_links)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def add_ways(
    app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: object
) -> None:
    """Says what stands at the side of pages that the list of contents does not have.

    A list of all contents would be most of such a page.
    """
    if page == "search":
        app.add_js_file("search.js")
    section = page.partition("/")[0]
    if section not in _INDICES or page == _INDICES[section][1]:
        return
    context["ways"] = [("Documentation", "contents"), _INDICES[section]]
    if section == "api":
        name = page.removeprefix("api/").partition("-")[0]
        public = known_paths().get(name)
        room = public.room if public and name not in public_rooms() else name
        context["room"] = room
        context["names"] = [
            (it.name, page_of(it))
            for it in (public_rooms()[room].names if room in public_rooms() else ())
        ]


_INDICES = {
    "api": ("Python, name by name", "api/index"),
    "decisions": ("All decisions", "decisions/README"),
    "games": ("All games", "games/index"),
}
"""The pages that list those of a section."""


def leave_foreign_names(app: Sphinx, doctree: nodes.document) -> None:
    """Names of types that have no page are not looked for among those that have."""
    for node in list(doctree.findall(pending_xref)):
        if node.get("refdomain") == "py" and node["reftarget"] not in known_paths():
            written = [it for it in node.children if it.get("condition") == "resolved"]
            node.replace_self(written[0].children if written else node.children)
