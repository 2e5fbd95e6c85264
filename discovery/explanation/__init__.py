"""What is known of a case, and how it is said: diagnosis.json, report, next experiments."""
