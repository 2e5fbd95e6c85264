"""Operating maps over fault severity: rows simulated and analysed, kept, summed up."""
