"""Where the data files and shaders are: inside the wheel, or beside the package in a checkout."""

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


def _folder(packaged: str, checkout: str) -> Path:
    inside = _PACKAGE / packaged
    return inside if inside.is_dir() else _PACKAGE.parent / checkout


def assets_folder() -> Path:
    """Folder of scenes, materials, constructions, weather, sensors and references."""
    return _folder("_assets", "assets")


def shaders_folder() -> Path:
    """Folder from which `#include` paths are read."""
    return _folder("_shaders", "shaders")
