"""Groups of slots that CIGI 3.3 and 4.0 share.

Fields are named as Wireshark's dissector names them [Wireshark4017], so that each can be compared with an independent
reading. Angles are in degrees, lengths in metres, temperatures in degrees Celsius, pressure in hPa. Limits keep out
what no host can mean; an angle may be any number of turns.
"""

from sensorsim.trainer.fields import Slot, bits, real, reals, whole

FARTHEST = 1e8  # [m] of an offset, a height or a range
FASTEST = 1e5  # [m s-1], [deg s-1]
WIDEST = 1e6  # [deg] of an angle: any turn of it is the same direction

ENTITY_CONTROL_FLAGS = (
    bits(
        ("entity_state", 2, 2),
        ("attach_state", 1),
        ("coll_det_request", 1),
        ("inherit_alpha", 1),
        ("ground_ocean_clamp", 2, 2),
    ),
    bits(("animation_dir", 1), ("animation_loop_mode", 1), ("animation_state", 2), ("extrapolation_enable", 1)),
)
COMPONENT = (whole("H", "component_id"), bits(("component_class", 6)), whole("B", "component_state"))
PART_ENABLES = bits(
    ("part_enable", 1),
    *((f"{axis}_enable", 1) for axis in ("xoff", "yoff", "zoff", "roll", "pitch", "yaw")),
)
SHORT_PARTS = (
    whole("H", "entity_id"),
    whole("B", "part_id_1"),
    whole("B", "part_id_2"),
    bits(("dof_select_1", 3, 6), ("dof_select_2", 3, 6), ("part_enable_1", 1), ("part_enable_2", 1)),
)
SHORT_PART_VALUES = reals("f", "dof_1", "dof_2", low=-FARTHEST, high=FARTHEST)
RATE_TARGET = (
    whole("H", "entity_id"),
    whole("B", "part_id"),
    bits(("apply_to_part", 1), ("coordinate_system", 1)),
)
RATES = reals("f", *(f"{axis}_rate" for axis in ("x", "y", "z", "roll", "pitch", "yaw")), low=-FASTEST, high=FASTEST)
SENSOR_CONTROL_FLAGS = (
    bits(
        ("sensor_on_off", 1),
        ("polarity", 1),
        ("line_dropout_enable", 1),
        ("auto_gain", 1),
        ("track_white_black", 1),
        ("track_mode", 3, 4),
    ),
    bits(("response_type", 1)),
)
SENSOR_CONTROL_KNOBS = (
    *reals("f", "gain", "level", low=0.0, high=1.0),
    real("f", "ac_coupling", 0.0, 1e9),
    real("f", "noise", 0.0, 1.0),
)
VIEW_DEFINITION_FLAGS = (
    bits(
        ("near_enable", 1),
        ("far_enable", 1),
        ("left_enable", 1),
        ("right_enable", 1),
        ("top_enable", 1),
        ("bottom_enable", 1),
        ("mirror_mode", 2),
    ),
    bits(("pixel_replication", 3), ("projection_type", 1), ("reorder", 1), ("view_type", 3)),
)
VIEW_CONTROL_ENABLES = bits(
    ("xoff_enable", 1),
    ("yoff_enable", 1),
    ("zoff_enable", 1),
    ("roll_enable", 1),
    ("pitch_enable", 1),
    ("yaw_enable", 1),
)
WEATHER_FLAGS = (
    bits(
        ("weather_enable", 1),
        ("scud_enable", 1),
        ("random_winds_enable", 1),
        ("random_lightning_enable", 1),
        ("cloud_type", 4),
    ),
)
ATMOSPHERE_VALUES = (
    real("f", "air_temp", -273.15, 1000.0),
    real("f", "visibility_range", 0.0, FARTHEST),
    real("f", "horiz_wind", 0.0, FASTEST),
    real("f", "vert_wind", -FASTEST, FASTEST),
    real("f", "wind_direction", -WIDEST, WIDEST),
    real("f", "barometric_pressure", 0.0, 1e5),
)
WEATHER_VALUES = (
    real("f", "air_temp", -273.15, 1000.0),
    real("f", "visibility_range", 0.0, FARTHEST),
    *reals("f", "scud_frequency", "coverage", low=0.0, high=100.0),
    real("f", "base_elevation", -FARTHEST, FARTHEST),
    *reals("f", "thickness", "transition_band", low=0.0, high=FARTHEST),
    *ATMOSPHERE_VALUES[2:],
    real("f", "aerosol_concentration", 0.0, 1e6),
)


def component_words(count: int) -> tuple[Slot, ...]:
    """Raw words that come with a component's state."""
    return tuple(whole("I", f"data_{number}") for number in range(1, count + 1))


def places(*prefixes: str) -> tuple[Slot, ...]:
    """Latitude, longitude, altitude, or offsets forward, right and down; which of them, other fields say."""
    names = [f"{prefix}{axis}" for prefix in prefixes for axis in ("lat_xoff", "lon_yoff", "alt_zoff")]
    return reals("d", *names, low=-FARTHEST, high=FARTHEST)


OFFSETS = reals("f", "xoff", "yoff", "zoff", low=-FARTHEST, high=FARTHEST)
ANGLES = reals("f", "roll", "pitch", "yaw", low=-WIDEST, high=WIDEST)
NORMAL = reals("f", "normal_vector_azimuth", "normal_vector_elevation", low=-WIDEST, high=WIDEST)
TRACK_PLACE = reals("d", "track_lat", "track_lon", "track_alt", low=-FARTHEST, high=FARTHEST)
GATE = (
    whole("H", "gate_x_size"),
    whole("H", "gate_y_size"),
    *reals("f", "gate_x_pos", "gate_y_pos", low=-WIDEST, high=WIDEST),
    whole("I", "frame_ctr"),
)
