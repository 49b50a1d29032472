"""Protocols that measure learners, and what they report: tables, figures, numbers."""
