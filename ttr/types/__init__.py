"""What there is: types, predicates, records, paths, as immutable values, and as text.

Read `syntax` (types), `objects` (records and paths) and `paths` first; `interning`
makes equal structure one object; `forms` and `substitution` build what others need;
`printing` writes any of it as notation or Python. May import: safety.
"""
