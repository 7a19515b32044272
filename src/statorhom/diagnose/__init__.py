"""Says what physics a study's model left out: locates the mismatch, names it, fits it, and says how sure that is.

Data goes through the folders in this order, and none imports from a later one:

    processes         what is independent, side by side; what is dear, remembered
    measured          what the tests of a study measured
    bases, contacts   small bases of a stator's modes; parts that meet over a contact
    stages            the tested steps as models of their constants
    predicted         what a test of a step would show
    features          measured against predicted, in standard deviations
    fits              explanations and their optimum
    located           where the mismatch is, and which effect would take it away
    next_measurement  what could be measured next, and what it would tell
    evidence          how sure an explanation is, and the rules by which it is named
    searches          the best explanations: of one effect, of two, and where no ordinary refit gets to
    coupons           the same of plates and wings

`diagnosis.py` is the whole way, `run.py` takes a study there and writes what is said of it.
"""
