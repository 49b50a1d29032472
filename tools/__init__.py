"""What makes the data that are shipped, and what looks after the code.

Run from the project's root, as modules: `python -m tools.fitting.merge DATA`. Nothing
here is installed, and nothing in `ttr` or `kille` imports it.
"""
