"""The energy of a relief, its gradient, and its Gauss-Newton operator."""
