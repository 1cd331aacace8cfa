"""Shipped profiles, a user's own, inheritance, and every fault told."""

import pytest

from relieffab import profiles
from relieffab.errors import InputError
from relieffab.machine import Rotary, cutting


@pytest.fixture
def own(tmp_path, monkeypatch):
    """Write profiles into a user folder of the test's own."""
    folder = tmp_path / "machines"
    monkeypatch.setattr(profiles, "user_folder", lambda: folder)

    def write(kind, name, text):
        path = folder / kind / f"{name}.toml"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    return write


@pytest.mark.parametrize(
    ("kind", "read", "count"),
    [
        ("machines", profiles.machine, 13),
        ("cutters", profiles.cutter, 16),
        ("materials", profiles.material, 8),
    ],
)
def test_every_shipped_profile_is_sound(kind, read, count, own):
    names = profiles.names(kind)
    assert len(names) == count
    for name in names:
        noun = read(name)
        assert noun.name == name
        assert noun.title
        assert noun.source


def test_the_default_machine_is_as_its_firmware_was_found(own):
    machine = profiles.machine()
    assert machine.name == "3018-prover"
    assert machine.travel == (263, 157, 34)
    assert machine.max_rate == (1600, 1600, 1600)
    assert machine.acceleration == (30, 30, 30)


def test_values_differ_per_axis_where_the_source_does(own):
    assert profiles.machine("3018-pro").max_rate == (1000, 1000, 800)
    assert profiles.machine("x-carve-1000").acceleration == (500, 500, 50)


@pytest.mark.parametrize("name", ["../machines/mine", "../../elsewhere", "sub/mine"])
def test_a_name_leads_nowhere_else(own, tmp_path, name):
    text = 'inherits = "3018-prover"'
    own("machines", "mine", text)
    own("machines/sub", "mine", text)
    (tmp_path / "elsewhere.toml").write_text(text, encoding="utf-8")
    assert profiles.machine("mine").name == "mine"
    with pytest.raises(InputError, match="no machine"):
        profiles.machine(name)
    with pytest.raises(InputError, match="no machine"):
        profiles.machine(str(tmp_path / "elsewhere"))


def test_stones_are_marked_as_unverified(own):
    for name in ("slate", "marble", "limestone", "granite"):
        assert not profiles.material(name).verified


def test_feeds_of_materials_name_cutters_and_machines_that_there_are(own):
    for name in profiles.names("materials"):
        for use in profiles.material(name).use:
            assert profiles.cutter(use.cutter).name == use.cutter
            assert all(profiles.machine(one).name == one for one in use.machines)
            assert len(use.source) > 20


def test_stones_and_small_tips_have_no_source(own):
    machine = profiles.machine("shapeoko-3")
    for name in profiles.names("materials"):
        material = profiles.material(name)
        wood = name in ("softwood", "hardwood", "mdf")
        assert cutting(profiles.cutter("flat-3.175"), material, machine).verified == wood
        assert not cutting(profiles.cutter("tapered-ball-1"), material, machine).verified


def test_a_users_own_feeds(own):
    own(
        "materials",
        "marble",
        'inherits = "marble"\n[[use]]\ncutter = "ball-6"\nfeed = 300\nsource = "my shop, 3 slabs"',
    )
    use = cutting(profiles.cutter("ball-6"), profiles.material("marble"), profiles.machine())
    assert (use.feed, use.source, use.verified) == (300, "my shop, 3 slabs", True)
    own("materials", "jade", 'inherits = "marble"\n[[use]]\ncutter = "ball-6"\nfeed = 300')
    with pytest.raises(InputError, match="source"):
        profiles.material("jade")


def test_inherited_values_are_kept_unless_given(own):
    base, heir = profiles.machine("lead-1010"), profiles.machine("lead-1515")
    assert heir.spindle == base.spindle
    assert heir.max_rate == (3500, 3500, 1000)


def test_units_are_read(own):
    own("cutters", "mine", 'inherits = "flat-6"\ndiameter = "0.25in"\nfeed = "10mm/s"')
    cutter = profiles.cutter("mine")
    assert (cutter.diameter, cutter.feed, cutter.flute_length) == (6.35, 600, 22)
    own("machines", "mine", 'inherits = "minimill"\ntravel = ["12cm", 120, "60mm"]')
    assert profiles.machine("mine").travel == (120, 120, 60)


def test_a_rotary_axis_is_read(own):
    assert profiles.machine("altmill-4x4").rotary is None
    assert profiles.machine("altmill-4x4-rotary").rotary == Rotary(7200, 360, 150)
    own("machines", "mine", 'inherits = "minimill"\n[rotary]\nmax_rat = 3600\ndiameter = 50')
    with pytest.raises(InputError, match=r"rotary.max_rate.*rotary.acceleration"):
        profiles.machine("mine")


def test_a_form_cutter_is_read_with_its_points(own):
    own(
        "cutters",
        "leaf",
        'title = "Leaf"\nshape = "form"\ndiameter = 3\n'
        'points = [[0, 0], ["0.5mm", 0.1], [1.5, 2]]\n'
        'flute_length = 4\nstickout = "1in"\nstepdown = 1\nfeed = 800\nplunge = 200\nrpm = 9000',
    )
    leaf = profiles.cutter("leaf")
    assert leaf.points == ((0, 0), (0.5, 0.1), (1.5, 2))
    assert leaf.stickout == 25.4


def test_a_users_profile_overrides_and_may_inherit_its_own_name(own):
    own("machines", "minimill", 'inherits = "minimill"\nsafe_height = 9')
    assert profiles.machine("minimill").safe_height == 9
    assert profiles.machine("minimill").travel == (120, 120, 60)
    assert profiles.names("machines").count("minimill") == 1


def test_package_data_comes_before_the_folder_beside(own, tmp_path, monkeypatch):
    package = tmp_path / "site" / "relieffab"
    material = 'title = "T"\nfeed = {}\nstepdown = 1\n'
    for folder, feed in ((package / "machines", 0.5), (package.parent / "machines", 0.7)):
        (folder / "materials").mkdir(parents=True)
        (folder / "materials" / "wax.toml").write_text(material.format(feed), encoding="utf-8")
    monkeypatch.setattr(profiles, "files", lambda name: package)
    assert profiles.material("wax").feed == 0.5
    (package / "machines" / "materials" / "wax.toml").unlink()
    (package / "machines" / "materials").rmdir()
    (package / "machines").rmdir()
    assert profiles.material("wax").feed == 0.7


def test_unknown_names_are_answered_with_the_nearest(own):
    with pytest.raises(InputError, match="did you mean 3018-prover"):
        profiles.machine("3018-provr")
    with pytest.raises(InputError, match="did you mean cutters"):
        profiles.names("cutter")


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ('inherits = "flat-6"\nstepover = 1', "stepover .did you mean stepdown"),
        ('inherits = "flat-7"', "did you mean flat-6"),
        ('inherits = "a"', "circle"),
        ("feed = = 3", "not TOML"),
        ('inherits = "flat-6"\ndiameter = "6 stone"', "diameter cannot be read"),
        ('inherits = "flat-6"\nshape = "star"', "shape"),
        ('shape = "flat"', "diameter.*flute_length.*stepdown"),
        ('inherits = "flat-6"\nfeed = 0', "feed cannot be 0"),
    ],
)
def test_faults_say_what_and_where(text, word, own):
    own("cutters", "bad", text)
    own("cutters", "a", 'inherits = "b"')
    own("cutters", "b", 'inherits = "a"')
    with pytest.raises(InputError, match=word):
        profiles.cutter("bad")


def test_a_shorter_circle_is_found_too(own):
    own("cutters", "a", 'inherits = "b"')
    own("cutters", "b", 'inherits = "a"')
    with pytest.raises(InputError, match="a -> b -> a"):
        profiles.cutter("a")
