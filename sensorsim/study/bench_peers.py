"""Other renderers on the same mesh, camera and size, where they are installed: a plain-colour frame with read-back.

Each runs in a process of its own, since some insist on the OpenGL of theirs: `python -m sensorsim.study.bench_peers
NAME FILE` prints the median time of a frame [ms] as JSON. The file holds the mesh and the camera.
"""

import importlib
import importlib.util
import json
import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.render import Camera
from sensorsim.scene import Mesh
from sensorsim.study.bench_timing import measure

MODULES = {"pyrender": "pyrender", "vtk": "pyvista", "panda3d": "panda3d.core"}
LONGEST = 300.0  # [s] that a peer may take
Given = Mapping[str, NDArray[Any]]


def peer_times(mesh: Mesh, camera: Camera, size: tuple[int, int], frames: int) -> dict[str, dict[str, float] | str]:
    """Wall and processor time of a frame [ms] by peer, or what went wrong; only those that are installed."""
    found: dict[str, dict[str, float] | str] = {}
    forward, _, up = camera.axes()
    with TemporaryDirectory() as folder:
        path = Path(folder) / "mesh.npz"
        np.savez(
            path, position=mesh.position.astype(np.float32), triangle=mesh.triangle, eye=camera.position,
            forward=forward, up=up, field=camera.half_extent(size), size=size, frames=frames,
        )  # fmt: skip
        for name, module in MODULES.items():
            if importlib.util.find_spec(module.partition(".")[0]) is not None:
                found[name] = _run(name, path)
    return found


def _run(name: str, path: Path) -> dict[str, float] | str:
    command = [sys.executable, "-m", "sensorsim.study.bench_peers", name, str(path)]
    environment = {**os.environ, "PYOPENGL_PLATFORM": "egl"}
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, env=environment, check=False)
    except subprocess.TimeoutExpired:
        return f"no answer within {LONGEST:g} s"
    lines = done.stdout.strip().splitlines()
    if done.returncode != 0 or not lines:
        return (done.stderr.strip().splitlines() or ["it said nothing"])[-1]
    times: dict[str, float] = json.loads(lines[-1])
    return times


def _half_angles(given: Given) -> tuple[float, float]:
    """Half the vertical field [rad] and the picture's width over its height."""
    width, height = given["field"]
    return float(np.arctan(height)), float(width / height)


def _pyrender(given: Given) -> Callable[[], Any]:
    pyrender, trimesh = importlib.import_module("pyrender"), importlib.import_module("trimesh")
    half, ratio = _half_angles(given)
    shape = trimesh.Trimesh(given["position"], given["triangle"], process=False)
    scene = pyrender.Scene(ambient_light=(1.0, 1.0, 1.0))
    scene.add(pyrender.Mesh.from_trimesh(shape, smooth=False))
    back = -given["forward"]
    pose = np.eye(4)
    pose[:3, :3] = np.column_stack([np.cross(given["up"], back), given["up"], back])
    pose[:3, 3] = given["eye"]
    scene.add(pyrender.PerspectiveCamera(yfov=2.0 * half, aspectRatio=ratio, znear=1.0, zfar=1e5), pose=pose)
    drawn = pyrender.OffscreenRenderer(*(int(side) for side in given["size"]))
    return lambda: drawn.render(scene, flags=pyrender.RenderFlags.FLAT)


def _vtk(given: Given) -> Callable[[], Any]:
    pyvista = importlib.import_module("pyvista")
    triangle = given["triangle"]
    faces = np.column_stack([np.full(len(triangle), 3), triangle]).ravel()
    plotter = pyvista.Plotter(off_screen=True, window_size=[int(side) for side in given["size"]])
    plotter.add_mesh(pyvista.PolyData(given["position"], faces), color="tan", lighting=False)
    camera = plotter.camera
    camera.position, camera.focal_point = tuple(given["eye"]), tuple(given["eye"] + given["forward"])
    camera.up, camera.view_angle = tuple(given["up"]), 2.0 * np.degrees(_half_angles(given)[0])
    camera.clipping_range = (1.0, 1e5)
    plotter.show(auto_close=False)

    def frame() -> Any:
        plotter.render()
        return plotter.screenshot(return_img=True)

    return frame


def _panda3d(given: Given) -> Callable[[], Any]:
    core = importlib.import_module("panda3d.core")
    core.load_prc_file_data("", "window-type offscreen\nload-display p3tinydisplay\naudio-library-name null")
    pipe = core.GraphicsPipeSelection.get_global_ptr().make_module_pipe("p3headlessgl")
    engine = core.GraphicsEngine.get_global_ptr()
    width, height = (int(side) for side in given["size"])
    properties, flags = core.FrameBufferProperties(), core.GraphicsPipe.BF_refuse_window
    properties.set_rgba_bits(8, 8, 8, 8)
    properties.set_depth_bits(24)
    sized = core.WindowProperties.size(width, height)
    window = engine.make_output(pipe, "bench", 0, properties, sized, flags)
    picture = core.Texture()
    window.add_render_texture(picture, core.GraphicsOutput.RTM_copy_ram)
    root, lens = core.NodePath("scene"), core.PerspectiveLens()
    root.attach_new_node(_panda_geometry(core, given))
    half, ratio = _half_angles(given)
    lens.set_fov(2.0 * np.degrees(np.arctan(np.tan(half) * ratio)), 2.0 * np.degrees(half))
    lens.set_near_far(1.0, 1e5)
    camera = root.attach_new_node(core.Camera("camera", lens))
    camera.set_pos(*given["eye"])
    camera.look_at(core.Point3(*(given["eye"] + given["forward"])), core.Vec3(*given["up"]))
    window.make_display_region().set_camera(camera)

    def frame() -> Any:
        engine.render_frame()
        return np.frombuffer(picture.get_ram_image(), np.uint8)

    return frame


def _panda_geometry(core: Any, given: Given) -> Any:
    data = core.GeomVertexData("mesh", core.GeomVertexFormat.get_v3(), core.Geom.UH_static)
    data.unclean_set_num_rows(len(given["position"]))
    memoryview(data.modify_array(0)).cast("B")[:] = given["position"].astype("<f4").tobytes()
    triangles = core.GeomTriangles(core.Geom.UH_static)
    triangles.set_index_type(core.Geom.NT_uint32)
    index = triangles.modify_vertices()
    index.unclean_set_num_rows(given["triangle"].size)
    memoryview(index).cast("B")[:] = given["triangle"].astype("<u4").tobytes()
    geometry, node = core.Geom(data), core.GeomNode("mesh")
    geometry.add_primitive(triangles)
    node.add_geom(geometry)
    return node


PEERS = {"pyrender": _pyrender, "vtk": _vtk, "panda3d": _panda3d}


def main(name: str, path: Path) -> None:
    """Time one peer and write the result for the process that asked."""
    with np.load(path) as stored:
        given = dict(stored)
    times = measure({name: PEERS[name](given)}, int(given["frames"]))[name]
    sys.stdout.write(json.dumps({"frame_ms": times.wall, "processor_ms": times.processor}) + "\n")


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
