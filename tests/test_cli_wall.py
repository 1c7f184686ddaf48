"""`sensorsim wall`: EnergyPlus's walls from CSV files, what it writes, and what it says of files that cannot be."""

import csv
import json
import math
import sys
from collections.abc import Callable
from datetime import datetime, timedelta, timezone
from pathlib import Path

import numpy as np
import pytest
from wall_cases import DATA, WALLS, FloatArray

from sensorsim.cli import main
from sensorsim.materials import load_construction
from sensorsim.thermal import march_wall, read_boundary

OUTSIDE = ("air_temperature", "sky_temperature", "ground_temperature", "beam", "sky_diffuse", "ground_reflected")
ROOM = ("--interior-air-temperature", "20", "--interior-film", "3.08")
START_UP = 2 * 1440  # [min] of EnergyPlus, not compared
FACINGS = ("N", "NE", "E", "SE", "S", "SW", "W", "NW", "H")
NAMES = {"brick": "brick", "steel_sheet": "steel_sheet", "wood_insulated": "insulated_wood"}

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Exit code, output and errors of `sensorsim wall ...`."""

    def call(*arguments: object) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["sensorsim", "wall", *map(str, arguments)])
        with pytest.raises(SystemExit) as left:
            main()
        told = capsys.readouterr()
        return int(left.value.code or 0), told.out, told.err

    return call


def write_series(path: Path, facing: str) -> tuple[FloatArray, list[str]]:
    """EnergyPlus's boundary of a facing as a file; minutes and times of the rows."""
    stored = np.load(DATA / "energyplus" / "boundary_1min.npz")
    minutes = stored["feb_t_min"]
    midnight = datetime(1977, 2, 1, tzinfo=timezone(timedelta(hours=-6)))
    times = [(midnight + timedelta(minutes=int(minute))).isoformat() for minute in minutes]
    place = FACINGS.index(facing)
    sun = [stored[f"feb_{part}"][:, place] for part in ("beam", "skydif", "gnddif")]
    columns = [stored["feb_Tair"], stored["feb_Tsky"], stored["feb_Tair"], *sun]
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["time", *OUTSIDE])
        writer.writerows(zip(times, *(np.round(column.astype(float), 6) for column in columns), strict=True))
    return minutes, times


def read_columns(path: Path) -> tuple[list[str], dict[str, FloatArray]]:
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    numbers = {name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name != "time"}
    return [row["time"] for row in rows], numbers


@pytest.mark.parametrize(
    ("wall", "facing"), [("brick", "S"), ("brick", "H"), ("wood_insulated", "SE"), ("steel_sheet", "W")]
)
def test_wall_from_a_file_follows_energyplus(run: Run, tmp_path: Path, wall: str, facing: str) -> None:
    """Rationale: the share F b of the sky at sky temperature, all else at air temperature, is a sky view of F b.

    Expected: outside r.m.s. 0.02 K and 99.9 % within 0.1 K (thin steel 0.03 and 0.2), inside r.m.s. 0.02 K in days 3
    to 8, with a Stefan-Boltzmann constant 0.012 % above EnergyPlus's: 0.0003 K r.m.s. on these walls.
    """
    minutes, times = write_series(tmp_path / "in.csv", facing)
    sky_view = 1.0 if facing == "H" else 0.5 * math.sqrt(0.5)
    code, _, _ = run(
        "--construction", NAMES[wall], "--boundary", tmp_path / "in.csv", "--out", tmp_path / "out.csv",
        "--absorptance", 0.7, "--emissivity", 0.9, "--interior-emissivity", 0.9, "--sky-view", sky_view,
        "--exterior-film", 20, *ROOM,
    )  # fmt: skip
    assert code == 0
    written, result = read_columns(tmp_path / "out.csv")
    assert written == times
    compared = (minutes % 10 == 0) & (minutes > START_UP)
    stored = np.load(DATA / "energyplus" / "temps_10min.npz")
    at = (minutes[compared] // 10 - 1, WALLS.index(wall), FACINGS.index(facing))
    outer = result["exterior_surface_temperature"][compared] - (25.0 + 0.002 * stored["feb_Tout"][(*at, 3)])
    inner = result["interior_surface_temperature"][compared] - (25.0 + 0.002 * stored["feb_Tin_a0.7"][at])
    rms, tail = (0.03, 0.2) if wall == "steel_sheet" else (0.02, 0.1)
    assert np.sqrt(np.mean(outer**2)) < rms
    assert np.quantile(np.abs(outer), 0.999) < tail
    assert np.sqrt(np.mean(inner**2)) < 0.02


# --- a small file ------------------------------------------------------------------------------------------------

GOOD = """\
# a note
time, air_temperature, beam
0, 10, 0
600, 11, 100
1800.5, 12, 0
"""
REST = ("--sky-temperature", "-5", "--ground-temperature", "8", "--exterior-film", "15", *ROOM)


@pytest.fixture
def call(run: Run, tmp_path: Path) -> Run:
    """Exit code, output and errors for the text of a boundary file; writes out.csv beside it."""

    def of(text: str, *options: object) -> tuple[int, str, str]:
        (tmp_path / "in.csv").write_text(text)
        paths = ("--boundary", tmp_path / "in.csv", "--out", tmp_path / "out.csv")
        return run("--construction", "brick", *paths, *options)

    return of


def test_columns_and_constants_give_what_the_function_gives(call: Run, tmp_path: Path) -> None:
    code, out, err = call(GOOD, *REST, "--nodes")
    assert (code, out.split()) == (0, ["wrote", str(tmp_path / "out.csv")])
    times, result = read_columns(tmp_path / "out.csv")
    assert times == ["0", "600", "1800.5"]
    constants = {
        "sky_temperature": -5.0, "ground_temperature": 8.0, "exterior_film": 15.0, "interior_air_temperature": 20.0,
        "interior_film": 3.08,
    }  # fmt: skip
    series = read_boundary(tmp_path / "in.csv", constants=constants)
    history = march_wall(
        load_construction("brick").layers, series.boundary, absorptance=0.7, emissivity=0.9, interior_emissivity=0.9,
        sky_view=0.5, keep_nodes=True,
    )  # fmt: skip
    assert history.nodes is not None
    assert result["exterior_surface_temperature"] + 273.15 == pytest.approx(history.exterior, abs=1e-7)
    assert result["interior_surface_temperature"] + 273.15 == pytest.approx(history.interior, abs=1e-7)
    nodes = [name for name in result if name.startswith("node_")]
    depth = [float(name.removeprefix("node_").removesuffix("_mm")) / 1e3 for name in nodes]
    assert depth == pytest.approx(history.grid.depth, rel=1e-3)
    assert result[nodes[-1]] + 273.15 == pytest.approx(history.nodes[:, -1], abs=1e-7)
    for said in ("taken as 0: sky_diffuse, ground_reflected", "slowest mode of the wall", "start: steady under"):
        assert said in err


def test_without_nodes_three_columns_are_written_and_json_tells_figures(call: Run, tmp_path: Path) -> None:
    code, out, _ = call(GOOD, *REST, "--json")
    assert code == 0
    header = (tmp_path / "out.csv").read_text().splitlines()[0]
    assert header == "time,exterior_surface_temperature,interior_surface_temperature"
    told = json.loads(out)
    assert told["files"] == [str(tmp_path / "out.csv")]
    assert told["start"]["kind"] == "steady"
    assert told["time_constant_h"] == pytest.approx(5.5, rel=0.1)
    assert abs(told["heat_J_m2"]["relative_residual"]) < 1e-12
    _, result = read_columns(tmp_path / "out.csv")
    warmest = result["exterior_surface_temperature"].max()
    assert told["exterior_surface_temperature_C"]["max"] == pytest.approx(warmest, abs=1e-6)


def test_times_in_different_offsets_are_one_series(call: Run, tmp_path: Path) -> None:
    seconds = "time,air_temperature\n0,10\n1800,12\n3600,14\n"
    moments = (
        "time,air_temperature\n1976-02-07T10:00:00-05:00,10\n1976-02-07T15:30Z,12\n1976-02-07T16:00:00.000+00:00,14\n"
    )
    assert call(seconds, *REST)[0] == 0
    _, plain = read_columns(tmp_path / "out.csv")
    assert call(moments, *REST)[0] == 0
    times, result = read_columns(tmp_path / "out.csv")
    assert times[1] == "1976-02-07T15:30Z"
    assert all(np.array_equal(result[name], plain[name]) for name in plain)


MOMENTS = "time,air_temperature\n1976-02-07T10:00:00-05:00,10\n1976-02-07T10:30:00-05:00,12\n"


@pytest.mark.parametrize(
    ("text", "kind", "head"),
    [(MOMENTS, ".png", b"\x89PNG"), (GOOD, ".svg", b"<?xml"), (GOOD, ".pdf", b"%PDF")],
    ids=["png", "svg", "pdf"],
)
def test_figure_is_drawn_in_the_kind_that_its_name_asks_for(
    call: Run, tmp_path: Path, text: str, kind: str, head: bytes
) -> None:
    code, out, _ = call(text, *REST, "--plot", tmp_path / f"figure{kind}")
    assert code == 0
    assert f"figure{kind}" in out
    assert (tmp_path / f"figure{kind}").read_bytes().startswith(head)
    assert "node_" not in (tmp_path / "out.csv").read_text()


def test_construction_of_ones_own_needs_no_names(run: Run, tmp_path: Path) -> None:
    (tmp_path / "in.csv").write_text(GOOD)
    (tmp_path / "wall.toml").write_text(
        "[[layer]]\nthickness = 0.1\nconductivity = 0.5\ndensity = 1000\nspecific_heat = 900\n"
        "[[layer]]\nresistance = 0.2\n"
    )
    paths = ("--boundary", tmp_path / "in.csv", "--out", tmp_path / "new" / "out.csv")
    assert run("--construction", tmp_path / "wall.toml", *paths, *REST)[0] == 0
    assert (tmp_path / "new" / "out.csv").exists()


PERFECT_FOAM = "[[layer]]\nthickness = 0.1\nconductivity = 1e-10\ndensity = 1000\nspecific_heat = 1000\n"
STUDS = """shape = "slab"
[path]
panel = 0.85
studs = 0.15
[[layer]]
path = "panel"
thickness = 0.09
conductivity = 0.04
density = 20
specific_heat = 1000
[[layer]]
path = "studs"
thickness = 0.09
conductivity = 0.14
density = 530
specific_heat = 1900
"""
TANK = """shape = "sphere"
radius = 0.3
[[layer]]
thickness = 0.3
conductivity = 2.0
density = 1000
specific_heat = 4000
"""


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (STUDS, "parallel paths by share of the area: panel 0.85, studs 0.15; nodes are those of the widest"),
        (TANK, "sphere of radius 0.3 m; heats are per exterior area"),
        (TANK.replace("sphere", "cylinder").replace("thickness = 0.3", "thickness = 0.01"), "cylinder of radius 0.3 m"),
    ],
    ids=["studs", "solid", "pipe"],
)
def test_studs_and_curved_walls_are_marched_plotted_and_told(call: Run, tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "stack.toml").write_text(text)
    words = ("--construction", tmp_path / "stack.toml", "--nodes", "--plot", tmp_path / "figure.png", "--json")
    code, out, err = call(GOOD, *REST, *words)
    assert code == 0
    assert said in err
    assert ("it is solid" in err) == (text == TANK)
    told = json.loads(out)
    assert abs(told["heat_J_m2"]["relative_residual"]) < 1e-10
    assert told["paths"] == ({"panel": 0.85, "studs": 0.15} if text == STUDS else {})
    assert (tmp_path / "figure.png").read_bytes().startswith(b"\x89PNG")
    _, result = read_columns(tmp_path / "out.csv")
    assert sum(name.startswith("node_") for name in result) == told["nodes"]
    assert all(np.all(np.isfinite(values)) for values in result.values())


def test_foam_that_hardly_conducts_takes_few_nodes(call: Run, tmp_path: Path) -> None:
    """Rationale: a day reaches a tenth of a micrometre into it; cells grow from there. Expected: below a thousand."""
    (tmp_path / "stack.toml").write_text(PERFECT_FOAM)
    code, out, _ = call(GOOD, *REST, "--construction", tmp_path / "stack.toml", "--json")
    assert code == 0
    assert json.loads(out)["nodes"] < 1000


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (TANK.replace("radius = 0.3\n", ""), "radius"),
        (TANK.replace("thickness = 0.3", "thickness = 0.4"), "layers reach 0.4 m deep"),
        (STUDS.replace("0.85", "0.5"), "path"),
        (TANK.replace("sphere", "cube"), "shape"),
    ],
    ids=["no radius", "too thick", "shares", "cube"],
)
def test_constructions_that_cannot_be_are_refused(call: Run, tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "stack.toml").write_text(text)
    code, out, err = call(GOOD, *REST, "--construction", tmp_path / "stack.toml")
    assert (code, out) == (2, "")
    assert message in err
    assert err.count("\n") == 1


# --- refusals ----------------------------------------------------------------------------------------------------

HEAD = "time,air_temperature\n"
ROWS = HEAD + "0,10\n600,11\n1200,12\n"
STAMP = "1976-02-07T10:{:02d}:00-05:00"
BAD: dict[str, tuple[str, tuple[str, ...], str]] = {
    "empty": ("", REST, "in.csv: file = 'in.csv': empty; begin with a row of column names: time, air_temperature"),
    "only a header": (HEAD, REST, "in.csv: rows = 0: too few; give two or more"),
    "one row": (HEAD + "0,10\n", REST, "in.csv: rows = 1: too few; give two or more"),
    "no time": ("air_temperature\n10\n11\n", REST, "line 1: columns = 'air_temperature': no column `time`"),
    "semicolons": (ROWS.replace(",", ";"), REST, "line 1: columns = 'time;air_temperature': no column `time`"),
    "NaN": (ROWS.replace("11", "nan"), REST, "line 3: air_temperature = 'nan': not a finite number; fill the gap"),
    "text": (ROWS.replace("11", "warm"), REST, "line 3: air_temperature = 'warm': not a number; fill the gap"),
    "comma for a point": (ROWS.replace("11", '"11,5"'), REST, "air_temperature = '11,5': not a number; write a point"),
    "nothing": (ROWS.replace("11", ""), REST, "line 3: air_temperature = '': empty; fill the gap"),
    "kelvin": (ROWS.replace("11", "284"), REST, "line 3: air_temperature = '284': above 150 C; check that"),
    "short row": (ROWS.replace(",11", ""), REST, "line 3: row = '600': 1 cells under 2 columns"),
    "time falls": (ROWS.replace("1200", "500"), REST, "line 4: time = '500': does not come after the row before"),
    "time twice": (ROWS.replace("1200", "600"), REST, "line 4: time = '600': does not come after the row before"),
    "gap": (ROWS.replace("1200", "12000"), REST, "line 4: time = '12000': 3.16667 h after the row before; fill"),
    "no offset": (
        f"{HEAD}{STAMP.format(0)},1\n{STAMP.format(1)[:-6]},2\n", REST,
        "line 3: time = '1976-02-07T10:01:00': no UTC offset; write 1976-",
    ),
    "seconds among moments": (
        f"{HEAD}{STAMP.format(0)},1\n60,2\n", REST, "line 3: time = '60': no ISO 8601 date and time; write 1976-",
    ),
    "moments among seconds": (
        f"{HEAD}0,1\n{STAMP.format(1)},2\n", REST, "line 3: time = '1976-02-07T10:01:00-05:00': not a number",
    ),
    "negative sun": (
        ROWS.replace("air", "beam").replace("beam_temperature", "beam").replace("11", "-3"),
        ("--air-temperature", "5", *REST), "line 3: beam = '-3': a negative irradiance; set the night's",
    ),
    "negative film": (ROWS, (*REST, "--exterior-film", "-1"), "constant: --exterior-film = -1.0: a negative film"),
    "film beyond all": (ROWS, (*REST, "--interior-film", "1e300"), "--interior-film = 1e+300: above 1e+09 W m-2 K-1"),
    "joules an hour": (ROWS, (*REST, "--beam", "2.5e6"), "constant: --beam = 2500000.0: above 100000 W m-2; give"),
    "infinite constant": (ROWS, (*REST, "--beam", "inf"), "constant: --beam = inf: not a finite number"),
    "missing": (ROWS, REST[2:], "in.csv: column = 'sky_temperature': missing; add the column [C], or give --sky-temp"),
    "missing film": (ROWS, REST[:-2], "column = 'interior_film': missing; add the column [W m-2 K-1], or give"),
    "unknown column": (
        ROWS.replace("air_temperature", "air_temprature"), REST,
        "line 1: column = 'air_temprature': unknown; rename it to air_temperature, in C, or",
    ),
    "column with a unit": (
        ROWS.replace("air_temperature", "Air Temperature [K]"), REST,
        "line 1: column = 'Air Temperature [K]': unknown; rename it to air_temperature, in C, or remove it",
    ),
    "column of nothing": (
        ROWS.replace("air_temperature", "rainfall"), REST, "line 1: column = 'rainfall': unknown; rename or remove it;",
    ),
    "column twice": (
        ROWS.replace("time,", "time,air_temperature,"), REST, "line 1: column = 'air_temperature': there twice",
    ),
    "column and constant": (ROWS, (*REST, "--air-temperature", "5"), "given as a constant too; drop the column or --"),
    "construction": (ROWS, (*REST, "--construction", "adobe"), "construction: name = 'adobe': no such construction"),
    "absorptance": (ROWS, (*REST, "--absorptance", "1.5"), "command line: --absorptance = 1.5: not from 0 to 1"),
    "emissivity": (ROWS, (*REST, "--emissivity", "nan"), "command line: --emissivity = nan: not from 0 to 1"),
    "step": (ROWS, (*REST, "--step", "0"), "command line: --step = 0.0: not a number above 0"),
    "step far too short": (ROWS, (*REST, "--step", "1e-9"), "wall: step = 1e-09: 6e+11 of them between two samples"),
    "start": (ROWS, (*REST, "--start", "cold"), "wall: start = 'cold': unknown; use one of auto, linear"),
    "short for periodic": (ROWS, (*REST, "--start", "periodic"), "the series covers less than a day; use the steady"),
    "kind of figure": (ROWS, (*REST, "--plot", "x.jpeg"), "--plot = 'x.jpeg': unknown kind of file; use .png"),
}  # fmt: skip


@pytest.mark.parametrize(("text", "options", "message"), BAD.values(), ids=BAD.keys())
def test_bad_input_gets_one_line_exit_code_2_and_no_file(
    call: Run, tmp_path: Path, text: str, options: tuple[str, ...], message: str
) -> None:
    code, out, err = call(text, *options)
    assert (code, out) == (2, "")
    assert message in err
    assert len(err.strip().splitlines()) == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["in.csv"]


def test_ground_that_nobody_sees_needs_no_temperature(call: Run) -> None:
    assert call(ROWS, *REST[:2], *REST[4:], "--sky-view", 1)[0] == 0
    assert call(ROWS, *REST[4:], "--emissivity", 0)[0] == 0
    assert call(ROWS, *REST[:2], *REST[4:], "--sky-view", 0.99)[0] == 2


def test_a_gap_that_the_user_accepts_is_bridged(call: Run) -> None:
    assert call(ROWS.replace("1200", "40000"), *REST, "--longest-gap", 12)[0] == 0


def test_missing_file_and_output_over_input_are_refused(run: Run, call: Run, tmp_path: Path) -> None:
    paths = ("--boundary", tmp_path / "none.csv", "--out", tmp_path / "out.csv")
    code, _, err = run("--construction", "brick", *paths, *REST)
    assert code == 2
    assert "none.csv: file = 'none.csv': No such file or directory; name a CSV file" in err
    code, _, err = call(ROWS, *REST, "--out", tmp_path / "in.csv")
    assert code == 2
    assert "--out" in err
    assert (tmp_path / "in.csv").read_text() == ROWS


def test_a_file_that_cannot_be_placed_takes_the_others_with_it(call: Run, tmp_path: Path) -> None:
    (tmp_path / "figure.png").mkdir()
    code, _, err = call(ROWS, *REST, "--plot", tmp_path / "figure.png")
    assert code == 2
    assert "figure.png" in err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["figure.png", "in.csv"]


def test_figure_without_matplotlib_says_what_to_install(
    call: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == "matplotlib" else name)
    code, _, err = call(ROWS, *REST, "--plot", tmp_path / "figure.png")
    assert code == 2
    assert "needs matplotlib; pip install 'sensorsim[study]'" in err
    assert not (tmp_path / "out.csv").exists()
