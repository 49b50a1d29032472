"""What a semanticist edits: grammars, meanings and wordings. Data, not code."""
