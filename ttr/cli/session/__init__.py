"""The command `ttr repl`: a session with a theory, line by line."""
