"""What the tests of a study measured, as the diagnosis sees it."""
