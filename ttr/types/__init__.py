"""The values of the theory: types, predicates, records and paths, and their text.

Read `syntax` (types), `objects` (records and paths) and `paths` first; `interning`
makes equal structure one object; `forms` and `substitution` build what others need;
`printing` writes any of it as notation or Python. May import: safety.
"""
