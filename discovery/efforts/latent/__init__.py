"""The linear model along a recording, and in it an unknown effort as a latent force: its chain, evidence and course."""
