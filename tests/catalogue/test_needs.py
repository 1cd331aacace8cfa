from pathlib import Path

from PIL import Image

from relieffab.catalogue.needs import memory_of

MiB = 2**20


def test_the_estimate_is_above_what_was_measured(tmp_path):
    peaks = [
        ("relief", (256, 192), 330), ("relief", (512, 384), 380), ("relief", (1024, 768), 581),
        ("relief", (2048, 1536), 1294), ("make", (256, 192), 700), ("make", (512, 384), 1253),
        ("make", (1024, 768), 1372), ("make", (2048, 1536), 1991),
    ]  # fmt: skip
    for stage, resolution, kilo in peaks:
        assert kilo * 1e6 <= memory_of(stage, resolution, Path("none.ply")) < 2 * kilo * 1e6


def test_a_large_model_takes_its_part(tmp_path):
    file = tmp_path / "scan.stl"
    with file.open("wb") as scan:
        scan.truncate(65_536_084)  # 1,310,720 triangles took 2,340 MiB
    assert 2340 * MiB <= memory_of("relief", (256, 192), file) < 1.3 * 2340 * MiB


def test_a_picture_counts_by_its_pixels_however_small_its_file(tmp_path):
    Image.new("RGB", (4000, 3000)).save(tmp_path / "photo.jpg")
    estimate = memory_of("relief", (512, 384), tmp_path / "photo.jpg")
    assert 1108e6 <= estimate < 1.3 * 1108e6
