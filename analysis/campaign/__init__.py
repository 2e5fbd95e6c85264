"""Campaigns: sweeps too large for a map, in chunks over the cores of this machine or over Dask workers elsewhere."""
