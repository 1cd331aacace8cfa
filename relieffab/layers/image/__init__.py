"""From a picture to Layers: a depth map, a normal map, a photograph or a drawing.

- In: `read` gives a `picture` from a file, `kind` says what it shows.
- Where the figure is: `figure`; where it lies on the panel: `fit`.
- Depth: `bands` takes the steps out of coarse greys, `scale` gives it its length,
  `steps` finds slopes that respect its jumps; `normalmap` and `integrate` go from
  normals to depth; `inflate`, `light` and `shape` from one photograph.
- Lines: `edges` finds them, `vector` follows them; a drawing's own are its `ink`.
- Out: `make` puts the layers together.
"""
