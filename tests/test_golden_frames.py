"""Frames against golden ones: on the software rasteriser in kelvin and radiance, elsewhere that they can be drawn."""

import os
from pathlib import Path

import imageio.v3 as imageio
import numpy as np
import pytest
from golden_frames import (
    FOLDER,
    GOLDENS,
    RASTERISER,
    SIZE,
    TEMPERATURE_TOLERANCE,
    Golden,
    draw,
    fault,
    inputs,
    read_golden,
    read_manifest,
    sha256,
)

EVIDENCE_VARIABLE = "SENSORSIM_GOLDEN_EVIDENCE"  # folder for what a failing comparison writes


def evidence_folder(tmp_path: Path) -> Path:
    return Path(os.environ.get(EVIDENCE_VARIABLE) or tmp_path)


@pytest.mark.parametrize("golden", GOLDENS, ids=lambda golden: golden.name)
def test_frame_is_the_golden_one(golden: Golden, tmp_path: Path) -> None:
    """5 mK, or 1e-4 of the radiance, for 99.75 % of the pixels. Other renderers than the golden frames' only run."""
    result, renderer = draw(golden)
    assert result.shape == SIZE[::-1]
    assert np.isfinite(result).all()
    if RASTERISER in renderer:
        wrong = fault(golden, result, read_golden(golden.name), evidence_folder(tmp_path))
        assert wrong is None, wrong


def test_manifest_names_every_golden_frame_and_its_inputs() -> None:
    manifest = read_manifest()
    assert RASTERISER in manifest["renderer"]
    assert {name: frame["inputs"] for name, frame in manifest["frames"].items()} == {
        golden.name: inputs(golden) for golden in GOLDENS
    }
    assert {path.stem: sha256(path) for path in FOLDER.glob("*.npz")} == {
        name: frame["sha256"] for name, frame in manifest["frames"].items()
    }


def test_golden_frames_stay_few_and_small() -> None:
    assert len(GOLDENS) <= 8
    assert SIZE[0] <= 160
    assert SIZE[1] <= 120
    assert sum(path.stat().st_size for path in FOLDER.iterdir()) < 300_000


def test_a_few_edge_pixels_may_differ_and_no_more(tmp_path: Path) -> None:
    golden = GOLDENS[0]
    reference = read_golden(golden.name)
    allowed = int(0.0025 * reference.size)
    result = reference.copy()
    result.ravel()[:allowed] += 20.0
    assert fault(golden, result, reference, tmp_path) is None
    assert list(tmp_path.iterdir()) == []
    result.ravel()[allowed] += 20.0
    assert fault(golden, result, reference, tmp_path) is not None


def test_a_failing_comparison_leaves_result_reference_and_difference(tmp_path: Path) -> None:
    golden = GOLDENS[0]
    reference = read_golden(golden.name)
    result = reference.copy()
    result[:48] += np.float32(5.0 * TEMPERATURE_TOLERANCE)
    wrong = fault(golden, result, reference, tmp_path / "new")
    assert wrong is not None
    assert "50.0" in wrong
    for kind in ("result", "reference", "difference"):
        path = tmp_path / "new" / f"{golden.name}_{kind}.png"
        assert str(path) in wrong
        assert imageio.imread(path).shape == reference.shape
    difference = imageio.imread(tmp_path / "new" / f"{golden.name}_difference.png")
    assert (difference[:48] > 120).all()
    assert (difference[48:] == 0).all()
    np.testing.assert_array_equal(read_golden(f"{golden.name}_result", tmp_path / "new"), result)
