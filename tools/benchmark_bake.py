"""Measure the bake of tables for all wall types of the catalogue: processor and elapsed time, best of several.

Elapsed time counts other people's work on the same machine, processor time does not; the machine's load is shown. With
--first also what a fresh process spends until its first tables: once with nothing compiled and once with all of it.

    python tools/benchmark_bake.py [--preset standard] [--weather winter] [--repeat 5] [--cores 2] [--first] [--json]
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from datetime import date
from pathlib import Path

from sensorsim.environment import Environment, build_environment, longest_lead_in, read_weather
from sensorsim.materials import WallType, load_catalogue
from sensorsim.tables import BakeSettings, ShadeTables, bake_tables, preset

ROOT = Path(__file__).resolve().parents[1]
GROUND = 93  # code of loam
FIRST = "import runpy; runpy.run_path({path!r}, run_name='first')['measure']({preset!r}, {weather!r}, 1)"


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--preset", default="standard")
    parser.add_argument("--weather", default="winter")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--cores", type=int, help="cores that may be used (Linux); all without")
    parser.add_argument("--first", action="store_true", help="also the first tables of a fresh process")
    parser.add_argument("--json", action="store_true", help="print all figures as JSON")
    options = parser.parse_args()
    if options.cores:
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[: options.cores])
    found = measure(options.preset, options.weather, options.repeat)
    if options.first:
        found["first"] = _first(options.preset, options.weather)
    print(json.dumps(found, indent=1) if options.json else _table(found))


def measure(name: str, weather: str, repeat: int) -> dict:
    """All figures of a preset in the weather of a day."""
    settings, catalogue = preset(name), load_catalogue()
    walls = [catalogue.wall_type(code, "heated") for code in sorted(catalogue.materials)]
    environment, ground = _environment(weather, settings), catalogue.wall_type(GROUND, "none")
    runs = [_bake(environment, walls, ground, settings) for _ in range(repeat)]
    tables = runs[-1][2]
    held = tables.coefficients.nbytes + (tables.lobes.weight.nbytes if tables.lobes is not None else 0)
    return {
        "preset": name, "weather": weather, "walls": len(walls), "threads": os.cpu_count(), "load": os.getloadavg()[0],
        "elapsed_s": min(run[0] for run in runs), "processor_s": min(run[1] for run in runs),
        "table_mib": held / 2**20,
    }  # fmt: skip


def _environment(weather: str, settings: BakeSettings) -> Environment:
    """The day that a file of weather is named after, with all days before it that a bake may want."""
    read = read_weather(weather)
    day = date.fromisoformat(read.file.stem[-10:])
    return build_environment(read, image_day=day, lead_in_days=longest_lead_in(read, day), step=settings.step)


def _bake(
    environment: Environment, walls: list[WallType], ground: WallType, settings: BakeSettings
) -> tuple[float, float, ShadeTables]:
    begin, busy = time.perf_counter(), time.process_time()
    tables = bake_tables(environment, walls, ground=ground, settings=settings)
    return time.perf_counter() - begin, time.process_time() - busy, tables


def _first(name: str, weather: str) -> dict:
    """Elapsed and processor time [s] of processes that bake once: nothing compiled before, and all."""
    code, spent = FIRST.format(path=str(Path(__file__).resolve()), preset=name, weather=weather), {}
    with tempfile.TemporaryDirectory() as cache:
        for state in ("nothing compiled", "all compiled"):
            begin, before = time.perf_counter(), os.times()
            subprocess.run(
                [sys.executable, "-c", code], check=True, cwd=ROOT,
                env=os.environ | {"NUMBA_CACHE_DIR": cache, "PYTHONPATH": str(ROOT)},
            )  # fmt: skip
            after = os.times()
            busy = after.children_user - before.children_user + after.children_system - before.children_system
            spent[state] = {"elapsed_s": time.perf_counter() - begin, "processor_s": busy}
    return spent


def _table(found: dict) -> str:
    bake = f"{found['preset']}, {found['weather']}: {found['walls']} wall types on {found['threads']} threads"
    lines = [
        f"{bake}, {found['table_mib']:.1f} MiB; load {found['load']:.1f}",
        f"{'':20} {'elapsed s':>10} {'processor s':>12}",
        f"{'bake':20} {found['elapsed_s']:10.2f} {found['processor_s']:12.2f}",
    ]
    lines += [
        f"{state:20} {row['elapsed_s']:10.2f} {row['processor_s']:12.2f}"
        for state, row in found.get("first", {}).items()
    ]
    return "\n".join(lines)


if __name__ == "__main__":
    main()
