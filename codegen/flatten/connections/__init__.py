"""connect() to equations: connectors, sets, streams, and graphs of overdetermined connectors."""
