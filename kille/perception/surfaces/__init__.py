"""Surfaces in a depth picture: patches, and which of them belong to one thing."""
