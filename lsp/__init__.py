"""What an editor asks: findings as one types, names under the cursor, formatting (README.md)."""
