"""Studies: theories of meaning that are compared by the dialogues that they lead to.

A study is written in one TOML file: its theories, tutors, scenes and seeds. All of them
are combined, so that every theory meets the same tutors in front of the same scenes.
"""
