"""The recording that would decide between explanations: limits of the inputs, waveforms, what they tell, files."""
