"""Measurements that could be made next: one file per kind, each a list of options with their costs, and the choice."""
