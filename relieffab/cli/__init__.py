"""The command line: one thin adapter a command."""
