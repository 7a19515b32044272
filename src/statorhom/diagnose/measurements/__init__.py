"""Measurements that could tell two explanations apart: one file per kind, each a list of options with their costs."""
