"""Classes with their modifications become a tree of components."""
