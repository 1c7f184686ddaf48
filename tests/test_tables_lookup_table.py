import moderngl
import numpy as np
import pytest
from glsl_harness import evaluate

from sensorsim.gpu import float_table
from sensorsim.tables import LookupTable


def _table(count: int = 64, minimum: float = 150.0, maximum: float = 700.0) -> LookupTable:
    values = 300.0 + 20.0 * np.cumsum(np.random.default_rng(count).normal(size=count))
    return LookupTable(
        name="warmth", quantity="Radiance", argument="Kelvin", minimum=minimum, maximum=maximum, values=values
    )


def _in_glsl(ctx: moderngl.Context, table: LookupTable, argument: np.ndarray) -> np.ndarray:
    texture = float_table(ctx, "warmth_table", table.texels)
    result = evaluate(
        ctx,
        "warmth(x)",
        {"x": argument.astype(np.float32)},
        include=["common/quantities.glsl", "generated/warmth.glsl"],
        generated={"warmth": table.glsl()},
        tables={"warmth_table": texture},
    )
    texture.release()
    return result


@pytest.mark.parametrize(
    ("count", "minimum", "maximum"), [(2, 0.0, 1.0), (64, 150.0, 700.0), (1024, 0.0, np.pi / 2), (2751, 150.0, 700.0)]
)
def test_shader_looks_up_what_numpy_looks_up(ctx: moderngl.Context, count: int, minimum: float, maximum: float) -> None:
    """Expected: the rounding of the argument times the steepest slope, at random places inside and outside."""
    table = _table(count, minimum, float(maximum))
    span = maximum - minimum
    argument = np.random.default_rng(2).uniform(minimum - 0.1 * span, maximum + 0.1 * span, 5000).astype(np.float32)
    steepest = np.abs(np.diff(table.values)).max() * (count - 1) / span
    allowed = 3e-7 * np.abs(argument).max() * steepest + 1e-6 * np.abs(table.values).max()
    assert np.abs(_in_glsl(ctx, table, argument) - table.evaluate(argument.astype(np.float64))).max() < allowed


def test_entries_map_to_themselves_and_ends_hold_beyond(ctx: moderngl.Context) -> None:
    table = _table(65, 0.0, 64.0)  # a spacing that single precision holds exactly
    np.testing.assert_array_equal(_in_glsl(ctx, table, np.arange(65.0)), table.values.astype(np.float32))
    beyond = _in_glsl(ctx, table, np.array([-1e6, -0.5, 64.5, 1e6]))
    np.testing.assert_array_equal(beyond, table.values[[0, 0, -1, -1]].astype(np.float32))
    np.testing.assert_array_equal(table.evaluate(np.array([-1e6, -0.5, 64.5, 1e6])), table.values[[0, 0, -1, -1]])


def test_halfway_between_entries_is_their_mean(ctx: moderngl.Context) -> None:
    table = _table(65, 0.0, 64.0)
    middle = np.arange(64.0) + 0.5
    exact = 0.5 * (table.values[:-1] + table.values[1:])
    np.testing.assert_allclose(table.evaluate(middle), exact, rtol=1e-14)
    np.testing.assert_allclose(_in_glsl(ctx, table, middle), exact, rtol=2e-7)
