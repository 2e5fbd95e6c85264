"""Reports and figures of maps and assessments."""
