import io

import numpy as np
from PIL import Image

from relieffab.catalogue.thumbnail import WIDTH, thumbnail
from relieffab.picture import png8, png16


def shown(folder):
    return np.asarray(Image.open(io.BytesIO(thumbnail(folder))))


def test_the_preview_is_shrunk(tmp_path):
    ramp = np.tile(np.linspace(0, 255, 960).astype(np.uint8), (720, 1))
    (tmp_path / "preview.png").write_bytes(png8(ramp))
    image = shown(tmp_path)
    assert image.shape == (3 * WIDTH // 4, WIDTH, 3)
    assert np.abs(image[100, :, 0] - np.linspace(0, 255, WIDTH)).max() < 8


def test_layers_alone_are_shown_by_their_shading(tmp_path):
    (tmp_path / "layers").mkdir()
    ramp = np.tile(np.linspace(0, 1, 64), (48, 1))
    (tmp_path / "layers" / "lambert.png").write_bytes(png16(ramp))
    image = shown(tmp_path)
    assert image.shape == (48, 64, 3)
    assert np.abs(image[20, :, 1] - 255 * ramp[0]).max() < 8
