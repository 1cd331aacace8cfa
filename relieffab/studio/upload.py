"""Uploads: bytes from the page to a model, counted as they come and parsed apart."""

import json
import re
import signal
import subprocess
import tempfile
from pathlib import Path

from relieffab.errors import InputError
from relieffab.layers.image.picture import Picture
from relieffab.layers.image.read import SUFFIXES as PICTURES
from relieffab.layers.mesh import USUAL_UP
from relieffab.studio import model, sheet
from relieffab.studio.children import Children
from relieffab.studio.model import Model
from relieffab.studio.sheet import Sheet

LARGEST = 512 << 20
"""Bytes of a model file."""
PATIENCE = 180.0
"""Seconds that parsing may take."""
TAKEN = (*USUAL_UP, *PICTURES, ".svg")
"""How files end that may be models."""


def safe_name(name: str) -> str:
    """Give a file name that leads nowhere: letters, digits, dots and dashes of the last part.

    Examples
    --------
    >>> safe_name("../../etc/My Horse (1).PLY")
    'My-Horse-1.ply'

    Raises
    ------
    InputError
        If it does not end as a model's file does.
    """
    last = re.split(r"[/\\]", name)[-1]
    stem, dot, suffix = last.rpartition(".")
    if not dot or f".{suffix.lower()}" not in TAKEN:
        raise InputError(
            "this is not a model file",
            expected=" ".join(TAKEN),
            found=repr(last[-40:]),
        )
    plain = re.sub(r"[^A-Za-z0-9]+", "-", stem).strip("-")[:60] or "model"
    return f"{plain}.{suffix.lower()}"


def refuse_size(count: int) -> None:
    """Raise InputError where a file has more bytes than are taken."""
    if count > LARGEST:
        raise InputError(
            "the model file is too large for the studio",
            expected=f"at most {LARGEST >> 20} MB",
            found=f"{count / (1 << 20):,.0f} MB or more",
            hint="a smaller one, or the command line: relieffab make",
        )


def parse(file: Path, children: Children) -> Model | Sheet:
    """Read a model in a process of its own, within limits of time and memory.

    Raises
    ------
    InputError
        If it holds nothing that can be carved, or breaks the limits.
    """
    with tempfile.TemporaryDirectory(prefix="relieffab-") as folder:
        with children.child("relieffab.studio.parse", [str(file), folder]) as process:
            try:
                said, _ = process.communicate(timeout=PATIENCE)
            except subprocess.TimeoutExpired:
                raise _too_long(file) from None
        if process.returncode == 0:
            kind = sheet if (Path(folder) / "sheet.json").is_file() else model
            return kind.load(Path(folder), file)
    if process.returncode == -signal.SIGXCPU:
        raise _too_long(file)
    try:
        fault: dict[str, str] = json.loads(said)
    except ValueError:
        raise InputError(
            "the model file cannot be read",
            found=f"reading it ended with status {process.returncode}",
            where=file.name,
        ) from None
    # What a library says may hold the whole path.
    told = {name: text.replace(str(file), file.name) for name, text in fault.items()}
    raise InputError(told.pop("message"), **{**told, "where": file.name})


def parse_mask(file: Path, children: Children, of: Model | Sheet | None) -> Sheet:
    """Read a mask as any model, and see that it fits the picture.

    Raises
    ------
    InputError
        If it cannot be read, does not fit, or there is no picture that it could be of.
    """
    if not isinstance(of, Sheet) or not isinstance(of.flat, Picture):
        raise InputError("only a picture has a mask", hint="open a picture first", where=file.name)
    mask = parse(file, children)
    if not isinstance(mask, Sheet) or mask.shape != of.shape:
        raise InputError(
            "the mask does not fit the picture",
            expected=f"a picture of {of.shape[1]} x {of.shape[0]} pixels",
            found=mask.about,
            where=file.name,
        )
    return mask


def _too_long(file: Path) -> InputError:
    return InputError(
        "the model takes too long to read",
        expected=f"at most {PATIENCE:g} s",
        where=file.name,
        hint="a smaller one, or the command line: relieffab make",
    )
