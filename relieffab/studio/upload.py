"""Uploads: bytes from the page to a model, counted as they come and parsed apart."""

import json
import re
import signal
import subprocess
import tempfile
from pathlib import Path

from relieffab.errors import InputError
from relieffab.layers.mesh import USUAL_UP
from relieffab.studio.children import Children
from relieffab.studio.model import Model, load

LARGEST = 512 << 20
"""Bytes of a model file."""
PATIENCE = 180.0
"""Seconds that parsing may take."""


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
    if not dot or f".{suffix.lower()}" not in USUAL_UP:
        raise InputError(
            "this is not a model file",
            expected=" ".join(USUAL_UP),
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
            hint="fewer triangles, or the command line: relieffab make",
        )


def parse(file: Path, children: Children) -> Model:
    """Read a model in a process of its own, within limits of time and memory.

    Raises
    ------
    InputError
        If it holds nothing that can be carved, or breaks the limits.
    """
    with tempfile.TemporaryDirectory(prefix="relieffab-") as folder:
        with children.child("relieffab.studio.parse", [str(file), folder]) as process:
            try:
                told, _ = process.communicate(timeout=PATIENCE)
            except subprocess.TimeoutExpired:
                raise _too_long(file) from None
        if process.returncode == 0:
            return load(Path(folder), file)
    if process.returncode == -signal.SIGXCPU:
        raise _too_long(file)
    try:
        fault = json.loads(told)
    except ValueError:
        raise InputError(
            "the model file cannot be read",
            found=f"reading it ended with status {process.returncode}",
            where=file.name,
        ) from None
    raise InputError(fault.pop("message"), **{**fault, "where": file.name})


def _too_long(file: Path) -> InputError:
    return InputError(
        "the model takes too long to read",
        expected=f"at most {PATIENCE:g} s",
        where=file.name,
        hint="fewer triangles, or the command line: relieffab make",
    )
