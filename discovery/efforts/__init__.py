"""Unknown efforts: an unknown input at every place of the equations; where the data asks for one, and what it is a
law of. See README.md of `discovery/`."""
