"""The notation of the papers: from a text to a type or an object.

A text is read in two steps. The parser makes a syntax tree of it: read `syntax_trees`
first, then `parser`, `term_parser` and `tokens`; `scanning` finds where statements
stand, `syntax_errors` says what is wrong with a text that is no notation. The `reader`
then says what each name in the tree means (`names`) and builds the type or the object;
`error_location` finds which part makes a type ill-formed. May import: judging and all
below it.
"""
