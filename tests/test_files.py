"""Files that belong together take their places together or not at all."""

from pathlib import Path

import pytest

from sensorsim.files import placed_whole


def test_files_take_their_places_only_at_the_end(tmp_path: Path) -> None:
    first, second = tmp_path / "a.png", tmp_path / "b.json"
    first.write_text("old")
    with placed_whole(first, second) as temporary:
        for path, suffix in zip(temporary, (".png", ".json"), strict=True):
            assert path.suffix == suffix, "writers go by the ending"
            path.write_text("new")
        assert first.read_text() == "old"
        assert not second.exists()
    assert [path.read_text() for path in (first, second)] == ["new", "new"]
    assert sorted(tmp_path.iterdir()) == [first, second]


def test_a_writer_that_fails_leaves_what_was_there(tmp_path: Path) -> None:
    first, second = tmp_path / "a", tmp_path / "b"
    first.write_text("old")

    def write_half() -> None:
        with placed_whole(first, second) as (half, _):
            half.write_text("new")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_half()
    assert first.read_text() == "old"
    assert list(tmp_path.iterdir()) == [first]


def test_none_stays_where_one_cannot_be_placed(tmp_path: Path) -> None:
    first, blocked = tmp_path / "a", tmp_path / "b"
    (blocked / "inside").mkdir(parents=True)

    def write_both() -> None:
        with placed_whole(first, blocked) as temporary:
            for path in temporary:
                path.write_text("new")

    with pytest.raises(IsADirectoryError):
        write_both()
    assert list(tmp_path.iterdir()) == [blocked]
