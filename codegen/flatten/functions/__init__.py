"""Calls of functions: of the language, of the model, and of the library."""
