"""Dialogues that were played, and how they are written down.

Read `dialogue` first: a `Dialogue` is what was given to a game and what came of it.
`stories` are dialogues as tests that anyone can write (`.dlg`), `logs` keep every turn
and replay it, `transcripts` draw dialogues as a page. `settings` find the game that a
story or a log names, `event_wording` has events and moves in words. `encounters` are
apart: there several participants play, each with a state of their own.
May import: theories and all below.
"""
