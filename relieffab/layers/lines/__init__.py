"""The line drawing: from a mesh to strokes, as vectors and as ink.

A mesh is faired and its bending measured (`smooth`, `curvature`, `surface`); each
kind of line is the zero set of a field on it (`contours`, `ridges`, `highlights`,
listed in `kinds`); what is seen of it becomes strokes (`chains`, `visibility`,
`trace`, `ends`, `strokes`), which are drawn (`image`) and written (`svg`).
"""
