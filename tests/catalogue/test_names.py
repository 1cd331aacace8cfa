import pytest
from hypothesis import given
from hypothesis import strategies as st

from relieffab.catalogue.lists import Wanted
from relieffab.catalogue.names import distinct_names


def names(*models):
    return distinct_names([Wanted("", model) for model in models])


@pytest.mark.parametrize(
    ("models", "expected"),
    [
        (["a/horse.ply", "a/horse.stl"], ["horse-ply", "horse-stl"]),
        (["a/horse.ply", "b/horse.ply"], ["a-horse", "b-horse"]),
        (["a/Horse.ply", "b/horse.ply"], ["a-Horse", "b-horse"]),
        (["a/horse.ply", "a/horse.ply"], ["horse", "horse-2"]),
        (["index.html.ply", "batch.json.ply"], ["index.html-ply", "batch.json-ply"]),
        (["..ply", "-o.stl", "a?b*.obj", ".../x. .ply"], ["model", "o", "a-b-", "x"]),
    ],
)
def test_names_by_as_much_of_the_path_as_it_takes(models, expected):
    assert names(*models) == expected


def test_a_name_that_was_given_is_kept():
    jobs = [
        Wanted("", "a/x.ply", name="Amun/Re"),
        Wanted("", "b/x.ply"),
        Wanted("", "c/Amun-Re.ply"),
    ]
    assert distinct_names(jobs) == ["Amun-Re", "x", "Amun-Re-ply"]


@given(st.lists(st.text(st.characters(exclude_categories=["Cs"]), min_size=1), max_size=8))
def test_names_are_distinct_and_stay_in_the_folder(stems):
    made = distinct_names([Wanted("", f"{stem}.ply", name=stem) for stem in stems])
    assert len({name.casefold() for name in made}) == len(stems)
    for name in made:
        assert name
        assert not name.startswith(".")
        assert "/" not in name
        assert name.isprintable()
        assert name not in ("index.html", "batch.json")
