"""Directional derivatives of the callbacks (runtime/include/mdl_tangent.h)."""
