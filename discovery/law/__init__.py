"""Laws that no catalogue holds: where effort is missing, and a sparse sum of terms that explains it."""
