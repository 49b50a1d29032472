"""The notation of the papers: from a text to a type or an object.

Read `notation.lark` and `reader` first; `grammar` makes trees (`syntax_trees`) of
texts, `syntax_errors` explains what is not taken, `names` are those that a text may
use. May import: building and all below it.
"""
