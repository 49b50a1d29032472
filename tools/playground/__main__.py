"""`python -m tools.playground FOLDER [--serve]`: build the playground, and show it."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from tools.playground.building import build
from tools.playground.pyodide import FetchError
from tools.playground.serving import server_of


def main() -> int:
    """Build; with --serve, serve until Ctrl-C."""
    parser = argparse.ArgumentParser(prog="playground", description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", default=Path("site/playground"))
    parser.add_argument("--serve", action="store_true", help="serve it on loopback")
    parser.add_argument("--port", type=int, default=8010)
    options = parser.parse_args()
    try:
        build(options.folder)
    except FetchError as error:
        sys.stderr.write(f"playground: {error}\n")
        return 1
    sys.stdout.write(f"playground: built in {options.folder}\n")
    if options.serve:
        try:
            server = server_of(options.folder, options.port)
        except OSError as error:
            sys.stderr.write(f"playground: port {options.port}: {error.strerror}\n")
            return 1
        address = f"http://127.0.0.1:{server.server_port}/"
        sys.stdout.write(f"playground: open {address} (Ctrl-C ends it)\n")
        sys.stdout.flush()
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            server.server_close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
