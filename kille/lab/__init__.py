"""The lab: theories and learners, played against tutors and scenes, and measured.

A study is written in one TOML file: its theories, tutors, scenes and seeds. All of them
are combined, so that every theory meets the same tutors in front of the same scenes. A
protocol teaches learners and asks them, without a dialogue around it.
"""
