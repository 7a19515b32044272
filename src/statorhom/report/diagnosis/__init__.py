"""The page that a diagnosis is read on."""
