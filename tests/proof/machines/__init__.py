"""Second edition of the proof: machines of many kinds, with models in the users' own files (see README.md)."""
