"""`python -m relieffab`."""

from relieffab.cli.main import main

if __name__ == "__main__":
    main()
