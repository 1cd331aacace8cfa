"""The marks a chisel leaves: a texture of the relief that its cutter makes by construction."""
