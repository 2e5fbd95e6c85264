"""From sampled phase currents to operating maps and severity: see README.md of this folder."""
