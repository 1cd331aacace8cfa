"""Relief, cutter and machine to motion."""
