"""Text to a machine: Grbl over serial."""
