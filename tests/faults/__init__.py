"""Faults of the disk put into every write of every command: README.md of tests/fuzz says how to run them."""
