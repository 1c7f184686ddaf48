"""Camera paths: tables, poses of tracking programs, resampling, and refusals that name line and value."""

import math
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from sensorsim.errors import InputError
from sensorsim.frames.camera_path import read_camera_path
from sensorsim.render import Camera
from sensorsim.scene.projection import LocalFrame

FRAME = LocalFrame(longitude=-84.02, latitude=39.82)
HEAD = "t,lat,lon,alt,yaw,pitch,roll,hfov"


def csv_path(folder: Path, *lines: str) -> Path:
    path = folder / "path.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_table_becomes_cameras_in_local_metres(tmp_path: Path) -> None:
    path = csv_path(tmp_path, "# a note", HEAD, "0,39.82,-84.02,100,350,-10,0,20", "2,39.83,-84.02,50,10,-5,2,30")
    route = read_camera_path(path, FRAME)
    assert route.time == (0.0, 2.0)
    first, second = route.camera
    assert first.position == pytest.approx([0.0, 0.0, 100.0], abs=1e-6)
    assert second.position[1] == pytest.approx(1110.3, abs=0.3)
    assert (second.yaw, second.pitch, second.roll, second.horizontal_field_of_view) == (10.0, -5.0, 2.0, 30.0)


def test_columns_may_stand_in_any_order(tmp_path: Path) -> None:
    path = csv_path(tmp_path, "hfov,roll,pitch,yaw,alt,lon,lat,t", "20,0,-10,350,100,-84.02,39.82,7")
    assert read_camera_path(path, FRAME).camera[0].yaw == 350.0


def test_resampling_goes_straight_and_turns_the_shorter_way(tmp_path: Path) -> None:
    path = csv_path(tmp_path, HEAD, "0,39.82,-84.02,100,350,-10,0,20", "2,39.82,-84.02,50,10,-5,2,30")
    route = read_camera_path(path, FRAME).resample(10.0)
    assert len(route.time) == 21
    assert route.camera[10].yaw == pytest.approx(0.0, abs=1e-9) or route.camera[10].yaw == pytest.approx(360.0)
    assert route.camera[10].position[2] == pytest.approx(75.0)
    assert route.camera[20].horizontal_field_of_view == pytest.approx(30.0)
    assert route.time[-1] == pytest.approx(2.0)


def test_poses_turn_back_into_angles(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    cameras = [
        Camera(
            position=rng.normal(0.0, 100.0, 3), yaw=float(rng.uniform(0, 360)), pitch=float(rng.uniform(-80, 80)),
            roll=float(rng.uniform(-170, 170)), horizontal_field_of_view=33.0,
        )
        for _ in range(20)
    ]  # fmt: skip
    lines = []
    for number, camera in enumerate(cameras):
        forward, right, up = camera.axes()
        quaternion = Rotation.from_matrix(np.column_stack([right, -up, forward])).as_quat()
        lines.append(" ".join(map(str, (0.1 * number, *camera.position, *quaternion))))
    path = tmp_path / "poses.tum"
    path.write_text("# timestamp tx ty tz qx qy qz qw\n" + "\n".join(lines), encoding="utf-8")
    route = read_camera_path(path, FRAME, horizontal_field_of_view=33.0)
    for found, camera in zip(route.camera, cameras, strict=True):
        assert np.allclose(found.position, camera.position)
        assert (found.yaw, found.pitch, found.roll) == pytest.approx((camera.yaw, camera.pitch, camera.roll), abs=1e-6)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ((HEAD,), "holds no camera"),
        (("t,lat,lon,alt",), "not those of a camera path"),
        ((HEAD, "0,39.82,-84.02,100,350,-10,0"), "line 2.*not 8 numbers"),
        ((HEAD, "0,39.82,nan,100,350,-10,0,20"), "line 2: lon = 'nan': no finite number"),
        ((HEAD, "0,39.82,-84.02,high,350,-10,0,20"), "line 2: alt = 'high'"),
        ((HEAD, "0,39.82,-84.02,100,350,-95,0,20"), "line 2: pitch = -95"),
        ((HEAD, "0,39.82,-84.02,100,350,-5,0,190"), "line 2: horizontal_field_of_view = 190"),
        ((HEAD, "1,39.82,-84.02,1,0,0,0,20", "1,39.82,-84.02,1,0,0,0,20"), "line 3: t = 1.0: not after"),
    ],
)
def test_bad_tables_are_refused_by_line(tmp_path: Path, lines: tuple[str, ...], said: str) -> None:
    with pytest.raises(InputError, match=said):
        read_camera_path(csv_path(tmp_path, *lines), FRAME)


def test_bad_poses_files_and_rates_are_refused(tmp_path: Path) -> None:
    poses = tmp_path / "poses.txt"
    poses.write_text("0 1 2 3 0 0 0 5\n", encoding="utf-8")
    with pytest.raises(InputError, match="not of length 1"):
        read_camera_path(poses, FRAME)
    with pytest.raises(InputError, match="no camera path by its name"):
        read_camera_path(Path(__file__), FRAME)
    with pytest.raises(InputError, match="cannot be read"):
        read_camera_path(tmp_path / "missing.csv", FRAME)
    route = read_camera_path(csv_path(tmp_path, HEAD, "0,39.82,-84.02,1,0,0,0,20"), FRAME)
    assert route.resample(5.0) == route
    with pytest.raises(InputError, match="rate"):
        route.resample(math.nan)
