"""What a fit starts from: settings, tests, densities, regions, and the names that modes can have."""
