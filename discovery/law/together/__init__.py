"""Laws at several places, or beside the error of a sensor: what is missing is found together."""
