"""What is said of a forecast and of a fleet: sentences, figures, pages."""
