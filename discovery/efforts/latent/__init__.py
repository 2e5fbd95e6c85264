"""An unknown effort as a latent force: its Markov chain, its evidence, its course."""
