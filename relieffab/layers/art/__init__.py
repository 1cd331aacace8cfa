"""From vector art to Layers: the paths of an SVG, or text in a font.

`svg` and `text` read, `tree` makes an SVG plain, `runs` parts lines of text by script
and direction, `curves` flattens, `clip` cuts, `art` is what both give, `fill` finds the
pixels inside, `make` puts the layers together.
"""
