"""Seeing: regions, features, and learners of words for things and places."""
