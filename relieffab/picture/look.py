"""What a relief will look like when its programs have run, beside what was wanted."""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL import Image, ImageDraw, ImageFont

from relieffab.picture.png import smaller
from relieffab.picture.stone import LIGHT, hillshade
from relieffab.picture.texture import Texture
from relieffab.relief.model import Relief

GAP = 12
LINE = 26  # pixels of the line above the pictures, at least


def predicted_look(
    wanted: Relief,
    carved: Relief,
    light: ArrayLike = LIGHT,
    *,
    texture: Texture = "stone",
    width: int = 800,
) -> NDArray[np.uint8]:
    """Light the wanted and the simulated surface alike, side by side.

    Parameters
    ----------
    wanted, carved : Relief
        Of one panel; they may differ in resolution.
    light : (3,) array_like
        Towards the key light.
    texture : {'stone', 'wood'}
        What they are carved in.
    width : int
        Most pixels across each picture.

    Returns
    -------
    (rows, cols, 3) ndarray of uint8
    """
    left, right = (
        smaller(hillshade(one, light, texture=texture), width) for one in (wanted, carved)
    )
    size = left.shape[1], left.shape[0]
    line = max(LINE, size[0] // 18)
    page = Image.new("RGB", (2 * size[0] + 3 * GAP, size[1] + GAP + line), "white")
    draw, letters = ImageDraw.Draw(page), ImageFont.load_default(size=round(0.6 * line))
    for k, (image, word) in enumerate(((left, "wanted"), (right, "as the programs leave it"))):
        x = GAP + k * (size[0] + GAP)
        picture = Image.fromarray(image)
        page.paste(picture if picture.size == size else picture.resize(size), (x, line))
        draw.text((x + size[0] / 2, line / 2), word, "black", letters, anchor="mm")
    return np.asarray(page)
