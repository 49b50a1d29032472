"""The robot: it looks, hears, updates its state, learns for good, and speaks."""
