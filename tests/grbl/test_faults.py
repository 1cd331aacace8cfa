"""The first of the random fault schedules; tests/benchmarks/faults.py runs ten thousand."""

import importlib.util
from pathlib import Path

import pytest

PATH = Path(__file__).parent.parent / "benchmarks" / "faults.py"
COUNT, PART = 600, 100


@pytest.fixture(scope="module")
def campaign():
    spec = importlib.util.spec_from_file_location("faults_campaign", PATH)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("first", range(0, COUNT, PART))
def test_whatever_goes_wrong_the_machine_ends_safe_and_the_path_is_the_program(campaign, first):
    outcomes = [campaign.try_schedule(seed) for seed in range(first, first + PART)]
    assert sum(outcome.unnoticed for outcome in outcomes) <= 1
    assert sum(outcome.error is None for outcome in outcomes) > PART / 20
    assert any(outcome.resumed for outcome in outcomes)


def test_a_broken_promise_would_show(campaign):
    good = campaign.try_schedule(3)
    good.noisy, good.error = False, None
    good.path = good.points[:4] + good.points[5:]
    with pytest.raises(AssertionError, match="missing"):
        campaign.judge(good)
    good.path, good.spindle = good.points, 900
    with pytest.raises(AssertionError, match="spindle"):
        campaign.judge(good)
