import io
from base64 import b64decode

import numpy as np
from PIL import Image

from relieffab.job.sheet.pictures import pictures
from relieffab.picture import png8, png16


def opened(picture):
    head, data = picture.uri.split(",")
    return head, Image.open(io.BytesIO(b64decode(data)))


def test_pictures_are_embedded_no_larger_than_a_page_shows_them(tmp_path, report):
    report["picture"] = {"file": "preview.png", "method": "hillshade"}
    grey = np.linspace(0, 1, 2000).repeat(100).reshape(2000, 100).T
    (tmp_path / "preview.png").write_bytes(png8((255 * np.dstack([grey] * 3)).astype(np.uint8)))
    (tmp_path / "relief.png").write_bytes(png16(grey))
    found = pictures(report, [tmp_path])
    assert list(found) == ["preview", "plan"]
    head, image = opened(found["preview"])
    assert (head, image.size) == ("data:image/jpeg;base64", (1200, 60))
    assert found["preview"].words == "What will be carved, seen straight on"
    # Ink where it is deep, none on the face.
    _, plan = opened(found["plan"])
    alpha = np.asarray(plan)[..., 3]
    assert alpha[:, 0].min() > 195
    assert alpha[:, -1].max() < 3


def test_the_newer_folder_goes_first_and_what_is_missing_is_left_out(tmp_path, report):
    report["picture"] = {"file": "preview.png", "method": "pyrender"}
    new, old = tmp_path / "new", tmp_path / "old"
    for folder, value in ((new, 250), (old, 5)):
        folder.mkdir()
        (folder / "preview.png").write_bytes(png8(np.full((4, 4), value, np.uint8)))
    _, image = opened(pictures(report, [new, old])["preview"])
    assert np.asarray(image).mean() > 240
    assert pictures(report, []) == {}
