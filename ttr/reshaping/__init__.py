"""Other types and records made of given ones: relabelled, flattened, generalised."""
