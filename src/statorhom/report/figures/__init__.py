"""Pictures of the report, each made from results and shape files alone."""
