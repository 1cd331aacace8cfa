import runpy
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

EXAMPLES = sorted((Path(__file__).parent.parent / "examples").glob("[0-9]*.py"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_example_makes_its_picture(path, tmp_path):
    picture = runpy.run_path(str(path))["run"](tmp_path, width=256)
    assert picture.name == f"{path.stem}.png"
    image = np.asarray(Image.open(picture))
    assert image.std() > 10
    kept = path.parent / "pictures" / picture.name
    assert kept.is_file(), "the picture in the repository is missing: run the example"


def test_there_are_examples():
    assert len(EXAMPLES) >= 5
