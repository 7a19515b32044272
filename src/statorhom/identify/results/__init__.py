"""What results.json tells of a fitted step: constants, losses, remarks, and tests of its materials."""
