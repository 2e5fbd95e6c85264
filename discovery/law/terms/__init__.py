"""What a law is made of: its terms, what they are along a trajectory, how they are told."""
