"""Prognosis: from the severities of a series of pre-flight tests to the use that remains."""
