"""Where settings come from: flags, environment, job file, user's configuration."""

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import platformdirs

from relieffab.errors import InputError
from relieffab.job.settings import Chosen, resolve
from relieffab.job.table import SETTINGS

PREFIX = "RELIEFFAB_"
FILES = ("model", "mask", "depth_map")
"""Settings that name a file."""

Source = tuple[str, Mapping[str, Any]]
"""Who says something, and what."""


def user_configuration() -> Path:
    """Return the file whose settings serve every job of this user."""
    return Path(platformdirs.user_config_dir("relieffab")) / "config.toml"


def read_toml(path: Path) -> dict[str, Any]:
    """Read a TOML file of settings."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise InputError(
            "there is no such job file", where=str(path), hint="relieffab init writes one"
        ) from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, OSError) as fault:
        raise InputError(
            "the job file cannot be read", found=str(fault), where=str(path)
        ) from fault


def from_environment(environment: Mapping[str, str]) -> list[Source]:
    """Return each RELIEFFAB_* variable as a source of its own; unknown ones are refused later."""
    return [
        (variable, {variable.removeprefix(PREFIX).lower(): text})
        for variable, text in sorted(environment.items())
        if variable.startswith(PREFIX)
    ]


def job_source(job_file: Path) -> Source:
    """Read a job file; files named in it are looked for beside it."""
    return str(job_file), beside(job_file.parent, read_toml(job_file))


def beside(folder: Path, values: Mapping[str, Any]) -> dict[str, Any]:
    """Look for the files that settings name in a folder."""
    found = {
        name: str(folder / values[name])
        for name in FILES
        if isinstance(values.get(name), str) and values[name]
    }
    return {**values, **found}


def gather(
    flags: Mapping[str, Any], job_file: Path | None, environment: Mapping[str, str]
) -> dict[str, Chosen]:
    """Resolve all settings: flag > RELIEFFAB_* > job file > user configuration > default.

    Files named in a job file are looked for beside it.
    """
    return layered(flags, environment, [job_source(job_file)] if job_file is not None else [])


def layered(
    flags: Mapping[str, Any], environment: Mapping[str, str], files: Sequence[Source]
) -> dict[str, Chosen]:
    """Resolve all settings as `gather` does, with any number of files, the strongest first."""
    sources: list[Source] = [("flag", flags), *from_environment(environment), *files]
    user = user_configuration()
    if user.is_file():
        sources.append((str(user), read_toml(user)))
    return resolve(sources)


def template() -> str:
    """Return the text of a job file that says what can be set, all at its default."""
    lines = ["# A job for relieffab: relieffab make JOB.toml -o FOLDER", ""]
    for setting in SETTINGS:
        value = f'{setting.name} = "{setting.default}"'
        lines += [f"# {setting.help}", value if setting.default else f"# {value}", ""]
    return "\n".join(lines)
