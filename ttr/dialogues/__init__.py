"""Dialogues as they were played: stories, logs, transcripts, encounters.

`stories` are tests that anyone can write (`.dlg`), `logs` keep every turn and replay
it, `transcripts` draw both as a page, `encounters` have several participants, each with
a state of their own. May import: theories and all below.
"""
