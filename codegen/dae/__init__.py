"""The hybrid DAE of a flat model: relations, event order, the initial system, and where each variable is kept."""
