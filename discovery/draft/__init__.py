"""From a model and recordings as they come to a case: a commented case.toml and recordings in its format."""
