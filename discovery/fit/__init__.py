"""Output error: a machine simulated with parameters, fitted to recordings, and how sure the result is."""
