"""Calls of programs to the robot, as what a tutor would say to it.

So programs and a tutor take turns in one dialogue, in its language, and there is one
way to learn. In each call `thing` is the number of the thing that "this" means.

| `do` | with | is as if a tutor said |
| --- | --- | --- |
| `say` | `text` | that |
| `teach` | `word`, `thing` | This is a cup. |
| `ask` | `thing` | What is this? |
| `forget` | `word` | Forget cup. |
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from kille.bus import BusError
from kille.dialogue.lexicon import Lexicon
from kille.dialogue.meanings import DialogueTypes, packaged_types
from kille.dialogue.wording import tell
from ttr import Record, RecordType, merge, record, rectype

_KNOWN = ("say", "teach", "ask", "forget")


def text_of(
    call: Mapping[str, Any], lexicon: Lexicon, types: DialogueTypes | None = None
) -> str:
    """What a tutor would say instead of a call; BusError if it is no call.

    >>> from kille.dialogue.lexicon import lexicon
    >>> text_of({"do": "teach", "word": "cup", "thing": 2}, lexicon("en"))
    '#2 This is a cup.'
    """
    return (
        f"{_pointing_prefix(call)}{_sentence(call, lexicon, types or packaged_types())}"
    )


def _sentence(call: Mapping[str, Any], lexicon: Lexicon, types: DialogueTypes) -> str:
    match call:
        case {"do": "say", "text": str(text)}:
            return text
        case {"do": "teach", "word": str(word)} if word.strip():
            sign = types.sign(word.strip(), "noun")
            content = _about_this(types.meaning_at(sign, "Naming"), types)
            return tell(lexicon, "instruct", record(content=content, signs=[sign]))
        case {"do": "ask"}:
            content = _about_this(types.record_type("Asked"), types)
            return _tell_without_signs(lexicon, "ask_name", content)
        case {"do": "forget", "word": str(word)} if word.strip():
            sign = types.sign(word.strip(), "noun")
            content = rectype(word=sign.meaning)
            return tell(lexicon, "forget_word", record(content=content, signs=[sign]))
    raise BusError(
        f"{_format_call(call)} is no call: `do` is {', '.join(_KNOWN)}; to teach and "
        "to forget need a `word`, to say a `text`"
    )


def _pointing_prefix(call: Mapping[str, Any]) -> str:
    match call.get("thing"):
        case None:
            return ""
        case bool():
            pass
        case int(number) if number > 0:
            return f"#{number} "
    raise BusError(f"{_format_call(call)}: `thing` is the number of a thing, from 1")


def _about_this(content: RecordType, types: DialogueTypes) -> RecordType:
    whole = merge(content, rectype(target=types["This"]))
    assert isinstance(whole, RecordType)
    return whole


def _tell_without_signs(lexicon: Lexicon, act: str, content: RecordType) -> str:
    said: Record = record(content=content, signs=())
    return tell(lexicon, act, said)


def _format_call(call: Mapping[str, Any]) -> str:
    return str({key: value for key, value in call.items() if key != "id"})
