"""The process in which the language server has files checked, one at a time.

It reads requests from its standard input and writes replies to its standard output,
each a line of JSON. A request names a `path`, gives the `texts` of files that are not
saved, by their paths, the folders to `allow`, and how many `steps` a check may take.
The first reply to it has the `names` in scope, the second the `findings` and the
`files` that were read. It ends when its input does, whatever it is doing: then nobody
is left who asked.
"""

from __future__ import annotations

import os
import sys
from dataclasses import asdict
from pathlib import Path
from queue import SimpleQueue
from threading import Thread
from typing import IO, Any

from ttr.editing.findings import Finding, check_file
from ttr.editing.outline import names_in_scope
from ttr.errors import describe_error
from ttr.escapes import json_text
from ttr.safety.budgets import budget
from ttr.safety.consent import Consent
from ttr.safety.inputs import parse_json


def answers(request: dict[str, Any]) -> Any:
    """The replies to a request, one after the other."""
    path = Path(request["path"])
    texts: dict[str, str] = request["texts"]
    consent = Consent.of(request["allow"], python=False)

    def text_of(one: Path) -> str | None:
        return texts.get(os.path.abspath(one))

    with budget(steps=request["steps"]):
        try:
            names = names_in_scope(path, consent, text_of)
            yield {"names": [asdict(one) for one in names]}
            checked = check_file(path, consent, text_of)
        except Exception as error:
            message = f"this could not be checked: {describe_error(error)}"
            yield {"findings": [asdict(Finding(str(path), message))], "files": []}
            return
    yield {
        "findings": [asdict(one) for one in checked.findings],
        "files": [os.path.abspath(one) for one in checked.files],
    }


def serve(incoming: IO[bytes], outgoing: IO[bytes]) -> None:
    """Answers requests until the input ends; then the process ends at once."""
    requests: SimpleQueue[bytes] = SimpleQueue()

    def read() -> None:
        for line in incoming:
            requests.put(line)
        os._exit(0)

    Thread(target=read, daemon=True).start()
    while True:
        for reply in answers(parse_json(requests.get())):
            outgoing.write(json_text(reply).encode() + b"\n")
            outgoing.flush()


if __name__ == "__main__":
    serve(sys.stdin.buffer, sys.stdout.buffer)
