"""The effects that are known, the places where they fit, and the model amended by them."""
