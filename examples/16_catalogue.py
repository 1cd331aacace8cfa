"""A list of models made into a catalogue by one command, and its sheet of small pictures."""

import json
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import trimesh
from PIL import Image, ImageDraw, ImageFont

import relieffab as rf
from relieffab.picture import png_small

LIST = """\
model,name,up,size,depth,roll,note
falcon.ply,Falcon,y,90x120mm,3mm,,
lotus.ply,Lotus,y,120x120mm,4mm,,
cat.ply,Cat,y,90x120mm,3mm,,
scarab.ply,Scarab,y,120x90mm,2.5mm,,
scarab.ply,Scarab leaning,y,120x90mm,2.5mm,12,the same model
rosette.svg,Rosette,,90x90mm,2mm,,from a drawing
"""
ROSETTE = "".join(
    f'<path transform="rotate({angle} 50 50)" d="M50 46 C40 34 42 14 50 6 C58 14 60 34 50 46 Z"/>'
    for angle in range(0, 360, 45)
)
CARD, LINE = 400, 44  # pixels


def collect(folder: Path, cell: float) -> Path:
    """Write models, a drawing and the list of what to make of them."""
    for name in ("falcon", "lotus", "cat", "scarab"):
        shape = rf.scarab() if name == "scarab" else getattr(rf, name)(cell=cell)
        trimesh.Trimesh(*shape, process=False).export(folder / f"{name}.ply")
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{ROSETTE}</svg>'
    (folder / "rosette.svg").write_text(svg)
    (folder / "list.csv").write_text(LIST)
    return folder / "list.csv"


def card(job: dict, catalogue: Path) -> np.ndarray:
    """Lay one job's small picture over its name and size."""
    page = Image.new("RGB", (CARD, CARD + LINE), "white")
    image = Image.open(catalogue / job["name"] / "thumbnail.jpg")
    image.thumbnail((CARD - 20, CARD - 20))
    page.paste(image, ((CARD - image.width) // 2, CARD - image.height))
    x, y = job["size_mm"]
    text = f"{job['name']}, {x:g} x {y:g} x {job['depth_mm']:g} mm"
    letters = ImageFont.load_default(size=LINE * 0.5)
    ImageDraw.Draw(page).text((CARD / 2, CARD + LINE / 2), text, "black", letters, anchor="mm")
    return np.asarray(page)


def run(folder: Path, width: int = 512) -> Path:
    """Make the catalogue; return the picture."""
    with TemporaryDirectory() as scratch:
        models = collect(Path(scratch), cell=110 / width)
        catalogue = Path(scratch, "catalogue")
        command = [sys.executable, "-m", "relieffab", "batch", models, "-o", catalogue]
        command += ["--stage", "relief", "--resolution", f"{width}x{width}"]
        subprocess.run(command, check=True)
        jobs = json.loads((catalogue / "batch.json").read_text())["jobs"]
        cards = [card(job, catalogue) for job in jobs]
    rows = [np.hstack(cards[:3]), np.hstack(cards[3:])]
    picture = folder / "16_catalogue.png"
    picture.write_bytes(png_small(np.vstack(rows)))
    return picture


if __name__ == "__main__":
    print(run(Path(__file__).parent / "pictures"))
