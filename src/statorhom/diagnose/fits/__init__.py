"""Explanations and their optimum: constants and the added effects' parameters, fitted to all tests together."""
