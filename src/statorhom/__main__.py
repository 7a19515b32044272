"""`python -m statorhom` is the command `statorhom`."""

from statorhom.cli import main

if __name__ == "__main__":
    main()
