"""Types made of types: well-formed record and function types, merge, relabelling.

Read `constructors` and `formation` (when is a type well-formed?), then `merging`;
each of the others does one thing to given types. May import: computing and
all below it.
"""
