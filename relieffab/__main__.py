"""`python -m relieffab`."""

from relieffab.cli.main import main

main()
