"""The account of a rule, however its effect is written."""

from __future__ import annotations

from functools import lru_cache

from ttr.updates.checks.accounts import OPAQUE, Account
from ttr.updates.checks.notation_effects import written
from ttr.updates.checks.python_effects import read
from ttr.updates.checks.python_sources import source_of
from ttr.updates.rules import Body, Rule

__all__ = ["account"]


@lru_cache(maxsize=1024)
def account(rule: Rule) -> Account:
    """What a rule's effect reads and writes, so far as that can be told."""
    if isinstance(rule.effect, Body):
        return written(rule, rule.effect)
    source = source_of(rule.effect)
    return OPAQUE if source is None else read(source, rule)
