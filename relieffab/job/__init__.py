"""A job's settings to a folder of finished files."""
