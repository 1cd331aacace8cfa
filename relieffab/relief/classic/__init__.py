"""The relief methods that came before: each from its own publication."""
