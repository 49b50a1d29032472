"""Types of strings of events as regular types: their forms, automata, inclusion."""
