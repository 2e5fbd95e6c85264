"""What names can mean: values, components, the scopes they are looked up in, and modifications."""
