"""The study of the forecasts: a simulated fleet that knows nothing of the filter, and scores."""
