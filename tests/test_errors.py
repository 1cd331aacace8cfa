from relieffab.errors import FindingsError, InputError, MachineError, suggest


def test_an_error_says_what_where_and_what_next():
    text = str(InputError("bad", expected="a", found="b", where="c", hint="d"))
    assert text == "bad\n  expected: a\n  found: b\n  where: c\n  try: d"


def test_an_error_keeps_its_parts_apart():
    error = InputError("bad", found="b", hint="d")
    assert (error.message, error.parts) == ("bad", {"found": "b", "hint": "d"})


def test_exit_statuses_are_those_of_the_command_line():
    assert [e.exit_status for e in (FindingsError, InputError, MachineError)] == [1, 2, 3]


def test_suggestions_ignore_case_and_fall_back_to_the_list():
    assert suggest("Marbel", ["marble", "slate"]) == "did you mean marble?"
    assert suggest("zzz", ["slate", "marble"]) == "one of: marble, slate"
