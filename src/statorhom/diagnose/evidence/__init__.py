"""How sure an explanation is: what it did not see, what chance does, and the rules by which it is named."""
