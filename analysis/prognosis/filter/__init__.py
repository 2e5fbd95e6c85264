"""From severities to a belief about the law and its rate: laws, the bank of filters, smoothing, crossings."""
