from relieffab.grbl.codes import ALARMS, ERRORS, alarm_meaning, error_meaning


def test_every_code_of_grbl_1_1_has_a_meaning_of_its_own():
    assert set(ERRORS) == {*range(1, 18), *range(20, 39)}
    assert set(ALARMS) >= set(range(1, 11))
    assert len(set(ERRORS.values())) == 36
    assert len(set(ALARMS.values())) == len(ALARMS)


def test_an_unknown_code_is_named():
    assert "99" in error_meaning(99)
    assert "42" in alarm_meaning(42)
