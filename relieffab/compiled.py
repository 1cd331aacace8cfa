"""The one door to the compiler: Numba with a cache it can always write to."""

import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import platformdirs

Function = TypeVar("Function", bound=Callable[..., Any])


def _writable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


def _cache_folder() -> Path:
    own = Path(platformdirs.user_cache_dir("relieffab")) / "kernels"
    return own if _writable(own) else Path(tempfile.gettempdir()) / f"relieffab-{os.getuid()}"


# Numba reads this once, when it is first imported.
os.environ.setdefault("NUMBA_CACHE_DIR", str(_cache_folder()))

import numba  # noqa: E402

prange = numba.prange


def kernel(function: Function) -> Function:
    """Compile a serial kernel; the result is cached on disk between runs."""
    return numba.njit(cache=True, nogil=True)(function)  # type: ignore[no-any-return]


def parallel_kernel(function: Function) -> Function:
    """Compile a kernel whose `prange` rows run on all cores.

    Rows must be independent of each other, so that the answer does not depend
    on the number of threads.
    """
    return numba.njit(cache=True, nogil=True, parallel=True)(function)  # type: ignore[no-any-return]
