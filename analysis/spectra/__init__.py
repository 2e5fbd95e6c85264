"""The C++ spectral chain on NumPy arrays."""
