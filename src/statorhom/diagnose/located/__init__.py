"""Where the mismatch is: which effect would take it away, and at which angle and height."""
