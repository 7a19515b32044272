"""Many machines of one geometry: fitted by several processes or computers, into one table."""
