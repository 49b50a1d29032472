"""The works that the documentation cites, `docs/references.bib`, and how it does."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache

from pybtex.database import Entry, Person, parse_file
from pybtex.plugin import register_plugin
from pybtex.style.formatting import toplevel
from pybtex.style.formatting.plain import Style as Plain
from pybtex.style.formatting.unsrt import date
from pybtex.style.template import (
    field,
    join,
    optional,
    optional_field,
    sentence,
    tag,
)

from tools.website.public_names import ROOT

REFERENCES = ROOT / "docs" / "references.bib"

BIBLIOGRAPHY = """\
# Works cited

The works that these pages cite. Which definitions of them are in the code, and where,
is told by [which definitions](/explanation/which-definitions.md).

```{bibliography}
:all:
:style: volumes
```
"""


class PlainWithVolumes(Plain):  # type: ignore[misc]
    """BibTeX's plain style, which leaves out the volume of an article without pages."""

    def get_article_template(self, e: Entry) -> object:
        """How an article stands in the bibliography."""
        volume = optional[" ", field("volume")]
        return toplevel[
            self.format_names("author"),
            self.format_title(e, "title"),
            sentence[join[tag("em")[field("journal")], volume], date],
            sentence[optional_field("note")],
        ]


register_plugin("pybtex.style.formatting", "volumes", PlainWithVolumes)


@cache
def cited_as() -> Mapping[str, str]:
    """The ways in which the pages cite a work, each with its place in the bibliography.

    >>> cited_as()["Dobnik and de Graaf 2017"]
    'cite-dobnik2017'
    """
    found: dict[str, str] = {}
    twice = set[str]()
    for key, entry in parse_file(str(REFERENCES), "bibtex").entries.items():
        for it in _citations(entry):
            twice |= {it} & found.keys()
            found[it] = f"cite-{key}"
    return {it: place for it, place in found.items() if it not in twice}


def _citations(entry: Entry) -> set[str]:
    """How a work can be cited: by its authors and the year, in parentheses or not."""
    names = [_surname(it) for it in entry.persons.get("author", [])]
    year = entry.fields.get("year", "")
    if not names or not year:
        return set()
    years = (year, f"({year})", f", {year}")
    return {
        f"{authors}{'' if it.startswith(',') else ' '}{it}"
        for authors in _authors(names)
        for it in years
    }


def _authors(names: Sequence[str]) -> set[str]:
    if len(names) == 1:
        return {names[0]}
    *others, last = names
    joined = {
        f"{', '.join(others)}{comma} {word} {last}"
        for comma in ("", ",")
        for word in ("and", "&")
    }
    short = {
        f"{names[0]} et al.",
        f"{names[0]} and others",
        f"{names[0]} and colleagues",
    }
    return joined | (short if others[1:] else set())


def _surname(person: Person) -> str:
    """The surname as it is cited, without the braces of BibTeX."""
    parts = [*person.prelast_names, *person.last_names]
    return re.sub(r"[{}]", "", " ".join(parts))
