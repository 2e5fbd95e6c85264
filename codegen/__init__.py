"""From Modelica source to a compiled model."""

import sys

# Expressions are trees walked by recursion; a sum of a few thousand terms is a deep one.
sys.setrecursionlimit(max(sys.getrecursionlimit(), 20_000))
