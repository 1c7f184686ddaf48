"""Frames on disk: named planes with units and settings, written whole or not at all, read back, and contact sheets."""

from sensorsim.frames.capture import plane_names, take_frame
from sensorsim.frames.contact_sheet import contact_sheet
from sensorsim.frames.frame import JSON, Frame, Plane, build_frame
from sensorsim.frames.reader import read_plane, read_sidecar
from sensorsim.frames.scale_bar import ScaleBar, radiance_scale, temperature_scale
from sensorsim.frames.writer import PLANE_FORMATS, inputs_sha256, require_writable, write_frame

__all__ = [
    "JSON",
    "PLANE_FORMATS",
    "Frame",
    "Plane",
    "ScaleBar",
    "build_frame",
    "contact_sheet",
    "inputs_sha256",
    "plane_names",
    "radiance_scale",
    "read_plane",
    "read_sidecar",
    "require_writable",
    "take_frame",
    "temperature_scale",
    "write_frame",
]
