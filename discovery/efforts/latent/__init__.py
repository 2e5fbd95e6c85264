"""The linear model along a recording, and an unknown effort in it as a latent force: its Markov chain, its evidence, its
course."""
