"""Theories as links: the text, compressed, is the fragment of the page's address."""

from __future__ import annotations

import base64
import binascii
import zlib

LONGEST_FRAGMENT = 20_000
"""How many characters a fragment may have: what browsers and mail let through."""

LONGEST_TEXT = 100_000
"""How many bytes the text in a fragment may have."""

LINK_START = "t="
"""How a fragment begins that is a theory."""

_RAW = -15
"""The window of a deflate stream without header and checksum (RFC 1951)."""


class LinkError(ValueError):
    """A text that makes no link, or a link without a text: says so in one line."""


def link_fragment(text: str) -> str:
    """The fragment of the link to a theory, without the #.

    It is t= and the text in UTF-8, by DEFLATE (RFC 1951) and base64url (RFC 4648)
    without padding. Raises `LinkError` for a text that is too long.

    >>> fragment = link_fragment("basic Ind")
    >>> fragment
    't=S0oszkxW8MxLAQA'
    >>> text_of_fragment(fragment)
    'basic Ind'
    """
    said = text.encode()
    packer = zlib.compressobj(9, zlib.DEFLATED, _RAW)
    packed = packer.compress(said) + packer.flush()
    fragment = LINK_START + base64.urlsafe_b64encode(packed).decode().rstrip("=")
    if len(said) > LONGEST_TEXT or len(fragment) > LONGEST_FRAGMENT:
        raise LinkError(
            f"the theory is too long for a link: at most {LONGEST_FRAGMENT:,} "
            f"characters when compressed, found {len(fragment):,}; send it as a file"
        )
    return fragment


def text_of_fragment(fragment: str) -> str:
    """The theory in a fragment; raises `LinkError` where there is none."""
    packed = fragment.removeprefix(LINK_START)
    if packed == fragment or len(fragment) > LONGEST_FRAGMENT:
        raise LinkError("the link has no theory in it, or is too long")
    try:
        padded = packed + "=" * (-len(packed) % 4)
        unpacker = zlib.decompressobj(_RAW)
        data = base64.urlsafe_b64decode(padded)
        said = unpacker.decompress(data, LONGEST_TEXT + 1)
        text = said.decode()
    except (binascii.Error, zlib.error, UnicodeError):
        raise LinkError("the link is damaged: no theory can be read from it") from None
    if len(said) > LONGEST_TEXT or not unpacker.eof:
        raise LinkError("the link is damaged, or its theory is too long")
    return text
