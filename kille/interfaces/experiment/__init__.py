"""`kille experiment`: check, run, show, replay, report and compare studies."""
