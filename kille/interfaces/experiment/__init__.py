"""`kille experiment`: studies checked, run, shown, replayed, reported and compared."""
