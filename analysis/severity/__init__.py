"""From features to a severity: tables, nuisances, assessment, robustness."""
