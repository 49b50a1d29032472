"""How values are shown: as matrices for a terminal, as LaTeX, as HTML."""
