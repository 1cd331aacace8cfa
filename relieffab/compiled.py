"""The one door to the compiler: Numba with a cache it can always write to."""

import functools
import os
import tempfile
import types
import zlib
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
    """Return a folder for these sources: a kernel built from others would be stale."""
    sources = sorted(Path(__file__).parent.rglob("*.py"))
    seen = repr([(path.name, path.stat().st_size, path.stat().st_mtime_ns) for path in sources])
    own = (
        Path(platformdirs.user_cache_dir("relieffab")) / f"kernels-{zlib.crc32(seen.encode()):08x}"
    )
    return own if _writable(own) else Path(tempfile.mkdtemp(prefix="relieffab-"))


# Read once, when Numba and its threads first start.  Threads that wait should
# sleep: on a busy machine, spinning ones turn a kernel of 0.1 ms into one of 30 ms.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")
os.environ.setdefault("NUMBA_CACHE_DIR", str(_cache_folder()))

import numba  # noqa: E402

prange = numba.prange


def limit_threads(count: int) -> None:
    """Let kernels called from this thread use at most so many threads."""
    numba.set_num_threads(min(count, numba.config.NUMBA_NUM_THREADS))


# Divisions by zero give infinities, as in NumPy: a test before each would keep
# loops from using vectors.
_USUAL: dict[str, Any] = {"cache": True, "nogil": True, "error_model": "numpy"}


def kernel(function: Function) -> Function:
    """Compile a serial kernel; the result is cached on disk between runs."""
    return numba.njit(**_USUAL)(function)  # type: ignore[no-any-return]


def summing_kernel(function: Function) -> Function:
    """Compile a serial kernel whose sums may be taken in any order, the same every time."""
    return numba.njit(fastmath={"reassoc"}, **_USUAL)(function)  # type: ignore[no-any-return]


def parallel_kernel(function: Function) -> Function:
    """Compile a kernel whose `prange` rows run on all cores.

    Rows must be independent of each other, so that the answer does not depend
    on the number of threads.
    """
    return numba.njit(parallel=True, **_USUAL)(function)  # type: ignore[no-any-return]


def adaptive_kernel(many: int) -> Callable[[Function], Function]:
    """Compile a kernel twice: with threads for large arrays, without for small ones.

    Waking a thread takes about 0.1 ms, as long as a small kernel itself.

    Parameters
    ----------
    many : int
        Size of the first argument from which threads pay.
    """

    def compile_both(function: Function) -> Function:
        # The cache on disk tells kernels apart by their names alone.
        twin: Any = types.FunctionType(
            function.__code__, function.__globals__, function.__name__, None, function.__closure__
        )
        twin.__qualname__ = f"{function.__qualname__}_together"
        alone, together = kernel(function), parallel_kernel(twin)

        @functools.wraps(function)
        def choose(first: Any, *rest: Any) -> Any:
            return (together if first.size >= many else alone)(first, *rest)

        return choose  # type: ignore[return-value]

    return compile_both
