"""The fit of a step: its constants with their priors, search, correction by finer meshes, posterior."""
