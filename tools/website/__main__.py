"""`python -m tools.website` builds the site into `site/`; `… serve` serves it."""

from __future__ import annotations

import argparse
import sys
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from sphinx.cmd.build import main as sphinx

from tools.website.composing import compose
from tools.website.html_check import lost_links
from tools.website.public_names import ROOT
from tools.website.source_pages import write_source_pages

SITE = ROOT / "site"
WORK = ROOT / "build" / "website"


def build(site: Path = SITE, work: Path = WORK) -> int:
    """Builds the site; 0 if nothing is wrong with it."""
    files = compose(work / "pages")
    status = sphinx(
        [
            *(
                "-b",
                "html",
                "-c",
                str(Path(__file__).parent),
                "-d",
                str(work / "doctrees"),
            ),
            *("-j", "2", "-q", "-W", "--keep-going"),
            *(str(work / "pages"), str(site)),
        ]
    )
    if status:
        return status
    write_source_pages(files, site / "source")
    lost = lost_links(site)
    for page, links in lost.items():
        print(f"{page}: nothing is at {', '.join(links)}", file=sys.stderr)
    return 1 if lost else 0


def serve(site: Path = SITE, port: int = 8000) -> None:
    """Serves the site to this computer alone, until Ctrl-C."""
    handler = partial(SimpleHTTPRequestHandler, directory=str(site))
    with ThreadingHTTPServer(("127.0.0.1", port), handler) as server:
        print(f"The site is at http://127.0.0.1:{server.server_port}/ until Ctrl-C.")
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            print()


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="python -m tools.website", description=__doc__
    )
    parser.add_argument("what", nargs="?", choices=["build", "serve"], default="build")
    parser.add_argument("--port", type=int, default=8000, help="of serve; 0: any")
    given = parser.parse_args()
    if given.what == "serve":
        serve(port=given.port)
        return 0
    status = build()
    if not status:
        print(f"The site is in {SITE.name}/: open {SITE.name}/index.html.")
    return status


if __name__ == "__main__":
    sys.exit(main())
