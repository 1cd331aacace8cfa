from relieffab.progress import silent
from relieffab.studio import warm


def test_every_step_can_be_taken():
    steps = warm.steps()
    assert len(steps) == 5
    for step in steps:
        step(silent)
