"""Session: what one person has open, and what was worked out of it."""

import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from relieffab.errors import InputError
from relieffab.job.load import FILES
from relieffab.job.seen import OF_MESHES
from relieffab.job.settings import Chosen, job_of, resolve
from relieffab.job.table import TABLE
from relieffab.studio import controls
from relieffab.studio.ask import Ask
from relieffab.studio.model import Model
from relieffab.studio.preview import FINE, Preview
from relieffab.studio.sheet import Sheet
from relieffab.studio.trial import Trial

LONGEST = 500
"""Letters of a setting."""


_APART = ("model", "paper")  # opened by itself; of templates alone
OF_FILES = ("up", *controls.OF_PICTURES)
"""Settings that are of one model's file, and not of the next one's."""


class Session:
    """A model, settings, and what was worked out.

    Parameters
    ----------
    chosen : mapping of Chosen
        What the settings are to begin with.
    """

    def __init__(self, chosen: Mapping[str, Chosen]) -> None:
        self.texts = {**_offered(chosen), "mask": ""}
        self.model: Model | Sheet | None = None
        self.masks: dict[str, Sheet] = {}
        self.preview = Preview()
        self.fine = Preview(FINE, whole=True, figures=self.preview.figures)
        self.trial = Trial()
        self.scratch = Path(tempfile.mkdtemp(prefix="relieffab-studio-"))

    def close(self) -> None:
        """Take away what lies on the disk."""
        shutil.rmtree(self.scratch, ignore_errors=True)

    def open(self, model: Model | Sheet, **of_file: str) -> None:
        """Take a model in place of the one before; `OF_FILES` are as given, or as by default."""
        before = [one.file for one in (self.model, *self.masks.values()) if one]
        self.model, self.masks = model, {}
        defaults = {name: TABLE[name].default for name in OF_FILES}
        self.texts = {**self.texts, **defaults, **of_file}
        for file in before:
            if file.parent.parent == self.scratch:
                shutil.rmtree(file.parent, ignore_errors=True)

    def new_place(self) -> Path:
        """Make a folder for a model file."""
        return Path(tempfile.mkdtemp(dir=self.scratch))

    def place_of_mask(self, name: str) -> Path:
        """Make a place for a mask; its name is neither the model's nor another mask's."""
        stem, _, suffix = name.rpartition(".")
        taken = {one.name for one in (self.model, *self.masks.values()) if one}
        names = (f"{stem}-{k}.{suffix}" if k else name for k in range(len(taken) + 1))
        return self.new_place() / next(one for one in names if one not in taken)

    def take_mask(self, mask: Sheet) -> str:
        """Keep a mask of the model, and choose it; its name is the setting's text."""
        self.masks[mask.name] = mask
        self.texts = {**self.texts, "mask": mask.name}
        return mask.name

    def settle(self, given: Mapping[str, Any]) -> Ask:
        """Take settings as the page has them, and say what is asked with them.

        Raises
        ------
        InputError
            If there is no model, or a setting is none or cannot be read; the settings
            stay as they were then.
        """
        if self.model is None:
            raise InputError("no model is open", hint="drop a model file on the page")
        texts = self.read(given)
        job = job_of(resolve([("studio", self._said_of_it(texts))]))
        self.texts = texts
        up = None if isinstance(self.model, Sheet) else job.up or self.model.up
        mask = self.masks[job.mask] if job.mask else None
        return Ask(self.model, replace(job, model=self.model.name, up=up), mask)

    def _said_of_it(self, texts: Mapping[str, str]) -> dict[str, str]:
        """Leave at their defaults those settings that say nothing of a model of this kind."""
        kind = self.model.kind if self.model else "mesh"
        idle: tuple[str, ...] = OF_MESHES if kind != "mesh" else ()
        idle += controls.OF_PICTURES if kind in ("mesh", "svg") else ()
        return {**texts, **{name: TABLE[name].default for name in idle}}

    def read(self, given: Mapping[str, Any]) -> dict[str, str]:
        """Lay settings over those there are.

        Raises
        ------
        InputError
            If one is not to be chosen here or cannot be read; it says where.
        """
        for name, text in given.items():
            if name not in controls.OFFERED:
                raise InputError("there is no such setting in the studio", found=repr(name)[:60])
            if not isinstance(text, str) or len(text) > LONGEST:
                raise InputError("the setting is not a text", found=repr(text)[:60], where=name)
            if name == "mask" and text and text not in self.masks:
                raise InputError("there is no such mask", found=repr(text)[:60], where=name)
            if text != self.texts[name]:
                _check_setting(name, text)
        return {**self.texts, **given}

    def job_file(self, folder: str = "") -> str:
        """Write the job file that makes what is seen.

        Parameters
        ----------
        folder : str
            Where the model and its mask lie, as seen from the job file; beside it if not given.
        """
        if self.model is None:
            raise InputError("no model is open", hint="drop a model file on the page")
        texts = {"model": self.model.name, **self._said_of_it(self.texts)}
        lines = ["# relieffab make job.toml -o FOLDER", ""]
        for name, text in texts.items():
            inside = folder and text and name in FILES
            lines.append(f"{name} = {_quoted(f'{folder}/{text}' if inside else text)}")
        return "\n".join(lines) + "\n"


def _check_setting(name: str, text: str) -> None:
    """Name the setting in what its reader says of a text."""
    try:
        resolve([("studio", {name: text})])
    except InputError as fault:
        cause = fault.__cause__ if isinstance(fault.__cause__, InputError) else fault
        raise InputError(cause.message, **{**cause.parts, "where": name}) from fault


def _offered(chosen: Mapping[str, Chosen]) -> dict[str, str]:
    """Take what the page can show of the settings, and refuse what it would leave out.

    Raises
    ------
    InputError
        If a job would come out other than it was asked for.
    """
    for name, one in chosen.items():
        known = name in controls.OFFERED or name in _APART
        if not known and one.origin != "default":
            raise InputError(
                f"the studio cannot show {name.replace('_', '-')} yet",
                where=one.origin,
                hint="leave it out here; relieffab make takes it",
            )
    return {name: one.text for name, one in chosen.items() if name in controls.OFFERED}


def _quoted(text: str) -> str:
    """Write a basic string of TOML."""
    escaped = "".join(
        f"\\u{ord(letter):04x}" if letter in '"\\' or not letter.isprintable() else letter
        for letter in text
    )
    return f'"{escaped}"'
