"""Conjugate gradients preconditioned by multigrid, for operators on a lattice of nodes."""
