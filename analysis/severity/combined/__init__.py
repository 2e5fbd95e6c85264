"""Combined faults: maps over two faults at once, both severities of a recording, and where they cannot be separated."""
