"""The notation of the papers: its grammar, its reader, theories in texts and files."""
