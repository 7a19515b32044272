"""Measurements that could be made next, and what each would tell."""
