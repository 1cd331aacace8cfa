"""Benchmarks look at the clock, so they are run by hand: nothing here is a test."""

collect_ignore_glob = ["*.py"]
