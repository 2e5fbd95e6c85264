"""Units of measure: their strings, what follows for expressions, and the check of a model."""
