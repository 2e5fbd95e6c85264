"""The history store: every assessment that was made, in a database."""
