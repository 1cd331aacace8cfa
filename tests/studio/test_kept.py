from relieffab.studio.kept import Kept


def test_the_last_of_each_stage_is_kept():
    kept, made = Kept(), []

    def make():
        made.append(len(made))
        return made[-1]

    assert kept.last("view") is None
    assert [kept.once("view", key, make) for key in (1, 1, 2, 2, 1)] == [0, 0, 1, 1, 2]
    assert kept.once("relief", 1, make) == 3
    assert (kept.last("view"), kept.last("relief")) == (2, 3)
