"""How the fitted numbers that come with the package were made."""
