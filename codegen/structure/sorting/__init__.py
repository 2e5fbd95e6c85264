"""Which equation gives which unknown, and in which order."""
