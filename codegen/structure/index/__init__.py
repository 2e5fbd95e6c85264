"""Higher index: which equations are differentiated, and which derivatives are states no more."""
