"""`python -m tools.website` builds the site into `site/`; `… serve` serves it."""

from __future__ import annotations

import argparse
import os
import shutil
import sys
from pathlib import Path

from sphinx.cmd.build import main as sphinx

from tools.playground.building import build as build_playground
from tools.playground.pyodide import FetchError
from tools.playground.serving import server_of
from tools.website.composing import compose
from tools.website.html_check import compact, lost_links
from tools.website.playground_links import HAS_PLAYGROUND
from tools.website.public_names import ROOT, names_without_example
from tools.website.source_pages import write_source_pages

SITE = ROOT / "site"
WORK = ROOT / "build" / "website"
MOST_BYTES = 30_000_000
"""The site may be so large, apart from what runs theories in the browser."""


def build(site: Path = SITE, work: Path = WORK) -> int:
    """Builds the site; 0 if nothing is wrong with it.

    Where Pyodide cannot be had, it is built without the playground, and says so.
    """
    for name in (bare := names_without_example()):
        print(f"{name} has no example in its docstring", file=sys.stderr)
    has_playground = add_playground(site)
    set_up_kernels(work / "ipython")
    files = compose(work / "pages", has_playground)
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
            *("-D", f"{HAS_PLAYGROUND}={int(has_playground)}"),
            *(str(work / "pages"), str(site)),
        ]
    )
    if status:
        return status
    for page in site.rglob("*.html"):
        text = page.read_text("utf-8")
        if (shorter := compact(text)) != text:
            page.write_text(shorter, encoding="utf-8")
    write_source_pages(files, site / "source", has_playground)
    lost = lost_links(site)
    for name, links in lost.items():
        print(f"{name}: nothing is at {', '.join(links)}", file=sys.stderr)
    if (size := size_of(site)) > MOST_BYTES:
        print(f"the site has {size:,} bytes, of {MOST_BYTES:,}", file=sys.stderr)
    return 1 if bare or lost or size > MOST_BYTES else 0


def set_up_kernels(folder: Path) -> None:
    """Has the kernels of notebooks read this folder, and nobody's own settings.

    They talk to nobody but this program, with signed messages: so they need not warn
    that they do so in the clear.
    """
    profile = folder / "profile_default"
    profile.mkdir(parents=True, exist_ok=True)
    settings = 'c.IPKernelApp.log_level = "ERROR"\n'
    (profile / "ipython_kernel_config.py").write_text(settings, encoding="utf-8")
    os.environ["IPYTHONDIR"] = str(folder)


def size_of(site: Path) -> int:
    """The bytes of a site, apart from what runs theories in the browser."""
    files = [it for it in site.rglob("*") if it.is_file()]
    apart = site / "playground"
    return sum(it.stat().st_size for it in files if not it.is_relative_to(apart))


def add_playground(site: Path) -> bool:
    """Builds the playground into the site; whether it could be built."""
    folder = site / "playground"
    try:
        build_playground(folder, documentation="../index.html")
    except FetchError as error:
        shutil.rmtree(folder, ignore_errors=True)
        print(f"The site has no playground: {error}", file=sys.stderr)
        return False
    return True


def serve(site: Path = SITE, port: int = 8000) -> int:
    """Serves the site to this computer alone, until Ctrl-C; the exit code."""
    try:
        server = server_of(site, port)
    except OSError as error:
        print(
            f"port {port}: {error.strerror}: choose another by --port", file=sys.stderr
        )
        return 1
    with server:
        print(f"The site is at http://127.0.0.1:{server.server_port}/ until Ctrl-C.")
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            print()
    return 0


def main() -> int:
    """Builds or serves, as the command line says; the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m tools.website", description=__doc__
    )
    parser.add_argument("what", nargs="?", choices=["build", "serve"], default="build")
    parser.add_argument("--port", type=int, default=8000, help="of serve; 0: any")
    given = parser.parse_args()
    if given.what == "serve":
        return serve(port=given.port)
    status = build()
    if not status:
        print(f"The site is in {SITE.name}/: open {SITE.name}/index.html.")
    return status


if __name__ == "__main__":
    sys.exit(main())
