"""The line drawing: from a mesh to strokes, as vectors and as ink.

- What is drawn: `names` and `drawing` say which lines and how.
- The surface: `edges`, `creases`, `smooth` with its `aggregation`, `curvature`, `jets`,
  `slopes`, and `surface`, which puts them together; `study`, which turns it to any view.
- The lines on it: `contours`, `ridges`, `highlights`, listed in `kinds`; each is the zero
  set of a field (`zeros`), joined into `chains`.
- What is seen of them: `outline`, `visibility`, `snap`, `contrast`.
- Strokes: `trace` and `ends` are the tools, `tidy` the rules, `strokes` the way through.
- Out: `image` is ink, `svg` the vectors.
"""
