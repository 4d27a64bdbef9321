"""`python -m kovacic`."""

from kovacic.cli.main import main

if __name__ == "__main__":
    main()
