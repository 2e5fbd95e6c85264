"""Recordings of pre-flight tests: read, checked, refused."""
