"""Places of any model's equations: read, opened with an input at each, and written into an amended model."""
