"""How values are drawn: as matrices for a terminal, as LaTeX, as HTML.

Read `render` first, then `layout`, which decides where everything stands; `text`,
`latex` and `html` draw it. May import: judging, types.
"""
