"""Files that can be trusted: archives of known size, databases of our own making."""
