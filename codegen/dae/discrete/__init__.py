"""What happens at events to discrete variables: an order of computing, what follows it, and how they start."""
