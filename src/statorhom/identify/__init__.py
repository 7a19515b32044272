"""Identifies materials from masses and measured modes, step by step: constants, their intervals, what no mode tells.

Data goes through the folders in this order, and none imports from a later one:

    processes   what is independent, side by side; how far it is
    parameters  constants with priors, ties and limits
    optimizers  global search
    inference   from residuals and a prior to all optima and the posterior around them
    stages      what a fit starts from: settings, tests, densities, regions
    residuals   simulated against measured frequencies
    bases       reduced models that stand in for the mesh
    surface     response surfaces that stand in for it, and the search on them
    fits        the fit of a step: search, correction by finer meshes, posterior
    comparison  measured and simulated modes at the result, side by side
    results     what results.json tells of a fitted step

`chain.py` takes a study there, all its steps one after the other.
"""
