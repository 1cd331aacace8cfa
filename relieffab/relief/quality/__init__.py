"""How good a relief is, in figures that compare one method with another."""
