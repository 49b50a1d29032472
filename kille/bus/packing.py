"""Bundles as bytes: those of a NumPy archive, which every NumPy reads.

`numpy.load(io.BytesIO(data))` gives the arrays; `facts` among them is JSON in UTF-8.
"""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from kille.bus.messages import Bundle, BusError
from kille.safety.archives import read_arrays
from ttr.safety.inputs import parse_json

_FACTS = "facts"


def pack(bundle: Bundle) -> bytes:
    """The bytes of a bundle.

    >>> one = unpack(pack(Bundle({"id": "7"}, {"up": np.arange(3)})))
    >>> one.facts["id"], one.arrays["up"]
    ('7', array([0, 1, 2]))
    """
    file = io.BytesIO()
    facts = np.frombuffer(format_facts(bundle.facts).encode(), np.uint8)
    np.savez(file, allow_pickle=False, **{_FACTS: facts}, **bundle.arrays)
    return file.getvalue()


def unpack(data: bytes) -> Bundle:
    """The bundle in these bytes; BusError if there is none."""
    try:
        arrays = read_arrays(data)
        facts = arrays.pop(_FACTS).tobytes().decode()
    except (ValueError, KeyError, OSError) as error:
        raise BusError(f"what came is no bundle of arrays ({error})") from error
    return Bundle(parse_facts(facts), arrays)


def format_facts(facts: Mapping[str, Any]) -> str:
    """Facts as JSON on one line."""
    return json.dumps(facts, ensure_ascii=False)


def parse_facts(text: str) -> Mapping[str, Any]:
    """The facts in JSON; BusError if it is not an object."""
    try:
        facts = parse_json(text)
    except ValueError as error:
        raise BusError(f"`{_short(text)}` is not JSON ({error})") from error
    if not isinstance(facts, dict):
        raise BusError(f"`{_short(text)}` should be an object, {{…}}")
    return facts


def _short(text: str) -> str:
    return text if len(text) <= 60 else f"{text[:59]}…"
