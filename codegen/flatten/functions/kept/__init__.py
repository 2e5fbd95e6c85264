"""Functions that must run at run time: their statements, their variables, and calls of them."""
