import os
import subprocess
import sys

import pytest

from relieffab.compiled import kernel


def test_a_kernel_computes():
    @kernel
    def total(x):
        return x.sum()

    import numpy as np

    assert total(np.arange(5.0)) == 10


@pytest.mark.parametrize("home", ["/nonexistent", "/proc"])
def test_kernels_are_cached_somewhere_where_home_cannot_be_written(home):
    code = "import os, relieffab.compiled; print(os.environ['NUMBA_CACHE_DIR'])"
    environment = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    environment |= {"HOME": home, "XDG_CACHE_HOME": f"{home}/cache"}
    if os.getuid() == 0 and home == "/nonexistent":
        environment |= {"HOME": "/dev/null", "XDG_CACHE_HOME": "/dev/null/cache"}
    ran = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    assert ran.stdout.strip().startswith(("/tmp", "/var"))


def test_with_threads_or_without_the_answer_is_the_same():
    import numpy as np

    from relieffab.compiled import adaptive_kernel, prange

    def double(x, out):
        for i in prange(len(x)):
            out[i] = 2 * x[i]

    x = np.arange(10.0)
    for many in (1, 1000):
        out = np.zeros(10)
        adaptive_kernel(many)(double)(x, out)
        np.testing.assert_array_equal(out, 2 * x)
