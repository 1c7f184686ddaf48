"""Vehicles from glTF and OBJ files: what a geometry or node is called says which part it is, and whether it moves.

A node called turret, gun, or part_N is the articulated part 1, 2 or N: its origin is the pivot, and it carries what
hangs from it. Axes as glTF has them: y up, z forward, metres [GLTF2021]; OBJ files are taken to have the same.
"""

import re
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.trainer.articulation import GUN, TURRET, Joint
from sensorsim.trainer.vehicle_shape import PARTS, VehicleShape, face_area

SUFFIXES = (".glb", ".gltf", ".obj")
MOST_PARTS = 255
MOST_TRIANGLES = 20_000  # turned on the processor, frame by frame
WORDS = {"engine": "engine", "motor": "engine", "exhaust": "exhaust", "track": "tracks", "wheel": "wheels",
         "tire": "wheels", "tyre": "wheels", "cabin": "cabin", "cab": "cabin"}  # fmt: skip
ARTICULATED = {"turret": TURRET, "gun": GUN, "barrel": GUN, "cannon": GUN}
_NUMBERED = re.compile(r"(?:^|[^a-z])part[ _-]?([0-9]{1,3})(?![0-9])")
_BODY_FROM_FILE = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


def read_vehicle(path: Path) -> VehicleShape:
    """The vehicle of a file; InputError for one that cannot be read, is empty or has too many triangles."""
    if path.suffix.lower() not in SUFFIXES:
        raise InputError(path, "model", path.suffix, "unknown kind of file", f"use {', '.join(SUFFIXES)}")
    try:
        scene: Any = trimesh.load_scene(path)
    except Exception as error:  # trimesh lets through whatever its readers raise
        raise InputError(path, "model", path.name, f"cannot be read: {error}", "give a sound file") from error
    triangles, parts, nodes = [], [], []
    for node in scene.graph.nodes_geometry:
        matrix, name = scene.graph[node]
        mesh = scene.geometry[name]
        if not hasattr(mesh, "faces") or len(mesh.faces) == 0:
            continue
        corners = (mesh.vertices @ matrix[:3, :3].T + matrix[:3, 3])[mesh.faces] @ _BODY_FROM_FILE.T
        corners = corners[face_area(corners) > 0.0]
        triangles.append(corners)
        parts.append(np.full(len(corners), PARTS.index(part_of(f"{node} {name}"))))
        nodes.append(np.full(len(corners), node, dtype=object))
    count = sum(map(len, parts))
    if not 1 <= count <= MOST_TRIANGLES:
        raise InputError(path, "triangles", count, f"not 1 to {MOST_TRIANGLES}", "simplify the model")
    return VehicleShape(
        name=path.stem,
        triangles=np.concatenate(triangles),
        part=np.concatenate(parts),
        joints=_joints(scene.graph, np.concatenate(nodes)),
    )


def _joints(graph: Any, node_of: NDArray[Any]) -> tuple[Joint, ...]:
    """Joints of the nodes whose names say so; a node below one of its own number belongs to that one."""
    below = {node: set(graph.transforms.successors(node)) | {node} for node in graph.nodes}
    numbers = {node: number for node in graph.nodes if (number := number_of(str(node))) is not None}
    found = []
    for node, number in sorted(numbers.items(), key=lambda item: len(below[item[0]])):
        if any(other != node and node in below[other] and numbers[other] == number for other in numbers):
            continue
        forward, right, down = (_BODY_FROM_FILE @ graph[node][0][:3, 3]).tolist()
        carries = np.array([which in below[node] for which in node_of], dtype=np.bool_)
        if carries.any():
            found.append(Joint(number=number, pivot=(forward, right, down), carries=carries))
    return tuple(found)


def number_of(name: str) -> int | None:
    """The articulated part that a node's name speaks of, None where it speaks of none."""
    numbered = _NUMBERED.search(name.lower())
    if numbered is not None:
        return int(numbered[1]) if int(numbered[1]) <= MOST_PARTS else None
    return next((number for word, number in ARTICULATED.items() if word in name.lower()), None)


def part_of(name: str) -> str:
    """The part that a name speaks of; skin where it speaks of none."""
    return next((part for word, part in WORDS.items() if word in name.lower()), "skin")
