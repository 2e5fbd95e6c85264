"""Tables of measured data: read from files, and turned into piecewise polynomials."""
