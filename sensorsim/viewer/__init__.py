"""A window to fly through a scene as a sensor sees it.

Keys, camera motion, clock, symbols, probe, recordings and state know neither window nor OpenGL. `window`, `gui`,
`overlay`, `panels`, `probe_panel`, `screen` and `viewer` need the extra `viewer` (GLFW and Dear ImGui) and are imported
by the command only.
"""

from sensorsim.viewer.actions import Inputs, Seen, advance, press
from sensorsim.viewer.probe import Probe, day_of_surface, probe_pixel
from sensorsim.viewer.recording import Recording, camera_at, write_camera_path
from sensorsim.viewer.script import read_script
from sensorsim.viewer.stage import Stage
from sensorsim.viewer.state import Place, ViewState

__all__ = [
    "Inputs",
    "Place",
    "Probe",
    "Recording",
    "Seen",
    "Stage",
    "ViewState",
    "advance",
    "camera_at",
    "day_of_surface",
    "press",
    "probe_pixel",
    "read_script",
    "write_camera_path",
]
