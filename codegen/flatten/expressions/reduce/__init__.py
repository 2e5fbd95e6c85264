"""sum, product, min and max, and what they go over."""
