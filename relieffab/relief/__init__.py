"""Layers to one height field within bounds."""
