"""Relief and stock to a watertight solid."""
