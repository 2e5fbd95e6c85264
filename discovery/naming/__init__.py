"""Hypotheses against each other: screened, fitted in a race, ranked by evidence, judged."""
