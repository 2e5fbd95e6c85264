"""Which laws could be the effort at a place: their terms, and regressions on what was located there."""
