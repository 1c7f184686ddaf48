"""Puts files in their places whole or not at all."""

import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def placed_whole(*paths: Path) -> Iterator[list[Path]]:
    """Temporary names to write to, in the folders of `paths`, which take their places together at the end.

    Files of the same names are replaced. On any error none of the temporary names stays, and none of `paths` that had
    been put in its place before another could not be. A temporary name ends like its path, as writers go by that.
    """
    mark = secrets.token_hex(4)
    temporary = [path.with_name(f".{path.stem}.{mark}.partial{path.suffix}") for path in paths]
    placed: list[Path] = []
    try:
        yield temporary
        for written, path in zip(temporary, paths, strict=True):
            written.replace(path)
            placed.append(path)
    except BaseException:
        for path in placed:
            path.unlink(missing_ok=True)
        raise
    finally:
        for written in temporary:
            written.unlink(missing_ok=True)
