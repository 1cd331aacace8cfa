"""Any product of the toolkit as something to look at."""
