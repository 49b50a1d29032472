"""Builds the site of the documentation: `python -m tools.website`."""
