"""Session: what one person has open, and what was worked out of it."""

import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from relieffab.errors import InputError
from relieffab.job.settings import Chosen, Job, job_of, resolve
from relieffab.studio import controls
from relieffab.studio.model import Model
from relieffab.studio.preview import FINE, Preview
from relieffab.studio.trial import Trial

LONGEST = 500
"""Letters of a setting."""


_APART = ("model", "paper")  # opened by itself; of templates alone


@dataclass(frozen=True)
class Ask:
    """What a person looks at: a model and the settings for it."""

    model: Model
    job: Job


class Session:
    """A model, settings, and what was worked out.

    Parameters
    ----------
    chosen : mapping of Chosen
        What the settings are to begin with.
    """

    def __init__(self, chosen: Mapping[str, Chosen]) -> None:
        self.texts = _offered(chosen)
        self.model: Model | None = None
        self.preview = Preview()
        self.fine = Preview(FINE, whole=True)
        self.trial = Trial()
        self.scratch = Path(tempfile.mkdtemp(prefix="relieffab-studio-"))

    def close(self) -> None:
        """Take away what lies on the disk."""
        shutil.rmtree(self.scratch, ignore_errors=True)

    def open(self, model: Model, *, up: str = "") -> None:
        """Take a model in place of the one before; which way is up goes with it."""
        before, self.model = self.model, model
        self.texts = {**self.texts, "up": up}
        if before and before.file.parent.parent == self.scratch:
            shutil.rmtree(before.file.parent, ignore_errors=True)

    def new_place(self) -> Path:
        """Make a folder for a model file."""
        return Path(tempfile.mkdtemp(dir=self.scratch))

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
        job = job_of(resolve([("studio", texts)]))
        self.texts = texts
        up = job.up or self.model.up
        return Ask(self.model, replace(job, model=self.model.name, up=up))

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
            if text != self.texts[name]:
                _check_setting(name, text)
        return {**self.texts, **given}

    def job_file(self, folder: str = "") -> str:
        """Write the job file that makes what is seen.

        Parameters
        ----------
        folder : str
            Where the model lies, as seen from the job file; beside it if not given.
        """
        if self.model is None:
            raise InputError("no model is open", hint="drop a model file on the page")
        model = f"{folder}/{self.model.name}" if folder else self.model.name
        lines = ["# relieffab make job.toml -o FOLDER", ""]
        for name, text in {"model": model, **self.texts}.items():
            lines.append(f"{name} = {_quoted(text)}")
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
