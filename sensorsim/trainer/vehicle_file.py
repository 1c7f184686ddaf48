"""Vehicles from glTF and OBJ files: what a geometry or node is called says which part it is.

Axes as glTF has them: y up, z forward, metres [GLTF2021]; OBJ files are taken to have the same.
"""

from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from sensorsim.errors import InputError
from sensorsim.trainer.vehicle_shape import PARTS, VehicleShape, face_area

SUFFIXES = (".glb", ".gltf", ".obj")
MOST_TRIANGLES = 20_000  # turned on the processor, frame by frame
WORDS = {"engine": "engine", "motor": "engine", "exhaust": "exhaust", "track": "tracks", "wheel": "wheels",
         "tire": "wheels", "tyre": "wheels", "cabin": "cabin", "cab": "cabin"}  # fmt: skip
_BODY_FROM_FILE = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


def read_vehicle(path: Path) -> VehicleShape:
    """The vehicle of a file; InputError for one that cannot be read, is empty or has too many triangles."""
    if path.suffix.lower() not in SUFFIXES:
        raise InputError(path, "model", path.suffix, "unknown kind of file", f"use {', '.join(SUFFIXES)}")
    try:
        scene: Any = trimesh.load_scene(path)
    except Exception as error:  # trimesh lets through whatever its readers raise
        raise InputError(path, "model", path.name, f"cannot be read: {error}", "give a sound file") from error
    triangles, parts = [], []
    for node in scene.graph.nodes_geometry:
        matrix, name = scene.graph[node]
        mesh = scene.geometry[name]
        if not hasattr(mesh, "faces") or len(mesh.faces) == 0:
            continue
        corners = (mesh.vertices @ matrix[:3, :3].T + matrix[:3, 3])[mesh.faces] @ _BODY_FROM_FILE.T
        corners = corners[face_area(corners) > 0.0]
        triangles.append(corners)
        parts.append(np.full(len(corners), PARTS.index(part_of(f"{node} {name}"))))
    count = sum(map(len, parts))
    if not 1 <= count <= MOST_TRIANGLES:
        raise InputError(path, "triangles", count, f"not 1 to {MOST_TRIANGLES}", "simplify the model")
    return VehicleShape(name=path.stem, triangles=np.concatenate(triangles), part=np.concatenate(parts))


def part_of(name: str) -> str:
    """The part that a name speaks of; skin where it speaks of none."""
    return next((part for word, part in WORDS.items() if word in name.lower()), "skin")
