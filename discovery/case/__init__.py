"""A case as it is brought: its file, its recordings, and what is wrong with them."""
