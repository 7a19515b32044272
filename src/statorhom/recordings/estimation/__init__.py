"""FRF estimation: receptances from hammer hits and from sine sweeps, and what is wrong with the records."""
