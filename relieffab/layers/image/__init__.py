"""From a picture to Layers: a depth map, a normal map, a photograph or a drawing.

- In: `read` gives a `picture` from a file, `kind` says what it shows.
- Where the figure is: `figure`, how plainly: `outline`; where it lies on the panel: `fit`.
- Depth, by `maps`: `bands` takes the steps out of coarse greys, `scale` gives it its
  length, `steps` finds slopes that respect its jumps; `normalmap` and `integrate` go
  from normals to depth, `rims` says what they hide, `guide` and `fuse` join a depth map.
- Depth of one photograph: `inflate`, `light`, and `shape`, whose surface `settle`s
  into `likeness` with the picture.
- Lines: `edges` finds them, `vector` follows them; a drawing's own are its `ink`.
- Out: `sight` is what is seen before it is drawn, `make` puts the layers together.
"""
