"""Press everything on the studio's page for a while: `studio_monkey.py [MINUTES]`, ten by default.

Prints how many events it took and what memory did; fails as the test does that it runs.
"""

import os
import sys
from pathlib import Path

import pytest

TEST = Path(__file__).parents[1] / "studio" / "page" / "test_monkey.py"


def main() -> int:
    """Run the test of random events for as long as is asked."""
    os.environ["STUDIO_MINUTES"] = sys.argv[1] if len(sys.argv) > 1 else "10"
    return int(pytest.main(["-s", "-q", str(TEST), "-k", "whatever"]))


if __name__ == "__main__":
    sys.exit(main())
