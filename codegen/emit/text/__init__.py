"""How C is written: names, literals, expressions, bodies, sequences of steps."""
