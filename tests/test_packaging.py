"""The wheel alone, away from the checkout, has all that a frame needs."""

import os
import subprocess
import sys
import zipfile
from collections.abc import Mapping
from pathlib import Path

import imageio.v3 as imageio
import pytest

ROOT = Path(__file__).resolve().parents[1]
FRAME_TIMEOUT = 300  # [s] a first run compiles the solver


def _run(*arguments: str, cwd: Path, env: Mapping[str, str] | None = None) -> str:
    """Standard output of this Python with arguments; its errors are the test's message."""
    result = subprocess.run(
        [sys.executable, *arguments],
        cwd=cwd,
        env=env,
        capture_output=True,
        text=True,
        timeout=FRAME_TIMEOUT,
        check=False,
    )
    assert result.returncode == 0, f"{' '.join(arguments)}\n{result.stdout[-2000:]}\n{result.stderr[-4000:]}"
    return result.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of the checkout, built with what is installed: nothing is fetched."""
    folder = tmp_path_factory.mktemp("wheel")
    _run("-m", "hatchling", "build", "--target", "wheel", "--directory", str(folder), cwd=ROOT)
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that holds the installed wheel and nothing else."""
    target = tmp_path_factory.mktemp("installed")
    options = ("--no-deps", "--no-index", "--no-compile", "--disable-pip-version-check", "--target", str(target))
    _run("-m", "pip", "install", *options, str(wheel), cwd=target)
    return target


@pytest.fixture
def elsewhere(installed: Path) -> dict[str, str]:
    """An environment in which the wheel comes first and the working folder is not on the path."""
    return {**os.environ, "PYTHONPATH": str(installed), "PYTHONSAFEPATH": "1"}


def test_wheel_carries_assets_shaders_and_licence_and_no_tests(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    data = {
        f"sensorsim/_{top}/{path.relative_to(ROOT / top).as_posix()}"
        for top in ("assets", "shaders")
        for path in (ROOT / top).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert sorted(data - names) == []
    assert "sensorsim/py.typed" in names
    assert [name for name in names if name.endswith("licenses/LICENSE")]
    assert {name.split("/")[0].split("-")[0] for name in names} == {"sensorsim"}


def test_installed_package_finds_its_data_inside_itself(
    installed: Path, elsewhere: dict[str, str], tmp_path: Path
) -> None:
    paths = "sensorsim.__file__, resources.assets_folder(), resources.shaders_folder()"
    code = f"import sensorsim; from sensorsim import resources; print({paths}, sep='\\n')"
    module, assets, shaders = map(Path, _run("-c", code, cwd=tmp_path, env=elsewhere).splitlines())
    assert module.is_relative_to(installed)
    assert (assets / "references.bib").is_file()
    assert assets.is_relative_to(installed)
    assert any(shaders.rglob("*.glsl"))
    assert shaders.is_relative_to(installed)


def test_installed_package_renders_a_frame(elsewhere: dict[str, str], tmp_path: Path) -> None:
    """Rationale: shaders and assets travel in the wheel. Expected: a picture of that size that shows something."""
    out = tmp_path / "frame.png"
    moment = ("--at", "1976-02-07T10:00", "--camera", "tower", "--size", "64x48", "--out", str(out))
    _run(
        "-m",
        "sensorsim",
        "render",
        "hospital",
        "--level",
        "IA",
        "--sensor",
        "flir",
        *moment,
        cwd=tmp_path,
        env=elsewhere,
    )
    picture = imageio.imread(out)
    assert picture.shape[:2] == (48, 64)
    assert picture.min() < picture.max()
