"""Sensors: the band they see, their optics and detector, what these make of radiance, and the display of it."""

from sensorsim.sensor.auto_gain import AutoGain
from sensorsim.sensor.dead_elements import REACH
from sensorsim.sensor.detail import DETAIL_REACH, EDGE, enhance_detail
from sensorsim.sensor.detector import Detector
from sensorsim.sensor.display import (
    DisplaySettings,
    auto_window,
    display_code,
    fix_window,
    grey_level,
    window_from_temperatures,
    window_limits,
)
from sensorsim.sensor.exposure import FILLED, exposure_for, sampled_surfaces
from sensorsim.sensor.focal_plane import column_places, focal_plane
from sensorsim.sensor.intensifier import Intensifier
from sensorsim.sensor.load import load_sensor, sensor_names
from sensorsim.sensor.memory import follows_in_time, remember, renewed_share
from sensorsim.sensor.noise import Noise
from sensorsim.sensor.optics import Optics
from sensorsim.sensor.parts import SHARP, sensor_parts, sensor_without
from sensorsim.sensor.point_spread import Kernel, blur_kernel, system_transfer
from sensorsim.sensor.random_field import deviate_table, normal_deviate
from sensorsim.sensor.raster import is_plain, source_rows
from sensorsim.sensor.read_out import correction_radiance, fixed_pattern, frame_noise, read_out, stream_seed
from sensorsim.sensor.row_chain import RowChain
from sensorsim.sensor.scan import Scan
from sensorsim.sensor.sensitivity import Sensitivity, netd, sensitivity
from sensorsim.sensor.sensor import Sensor
from sensorsim.sensor.settling import MEMORY
from sensorsim.sensor.spill import HALO_BLOCK, STREAK_BLOCK, halo_radius, kept_per_block
from sensorsim.sensor.tone import TONE_ENTRIES, tone_curve

__all__ = [
    "DETAIL_REACH",
    "EDGE",
    "FILLED",
    "HALO_BLOCK",
    "MEMORY",
    "REACH",
    "SHARP",
    "STREAK_BLOCK",
    "TONE_ENTRIES",
    "AutoGain",
    "Detector",
    "DisplaySettings",
    "Intensifier",
    "Kernel",
    "Noise",
    "Optics",
    "RowChain",
    "Scan",
    "Sensitivity",
    "Sensor",
    "auto_window",
    "blur_kernel",
    "column_places",
    "correction_radiance",
    "deviate_table",
    "display_code",
    "enhance_detail",
    "exposure_for",
    "fix_window",
    "fixed_pattern",
    "focal_plane",
    "follows_in_time",
    "frame_noise",
    "grey_level",
    "halo_radius",
    "is_plain",
    "kept_per_block",
    "load_sensor",
    "netd",
    "normal_deviate",
    "read_out",
    "remember",
    "renewed_share",
    "sampled_surfaces",
    "sensitivity",
    "sensor_names",
    "sensor_parts",
    "sensor_without",
    "source_rows",
    "stream_seed",
    "system_transfer",
    "tone_curve",
    "window_from_temperatures",
    "window_limits",
]
