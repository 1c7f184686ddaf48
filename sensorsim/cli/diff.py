"""`sensorsim diff`: how far two frames are apart."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from sensorsim.cli.options import AsJson
from sensorsim.errors import InputError
from sensorsim.frames.difference import compare_frames


def diff(
    first: Annotated[Path, typer.Argument(help="A frame with its sidecar, or a radiometric JPEG of a camera.")],
    second: Annotated[Path, typer.Argument(help="The frame to compare with it.")],
    plane: Annotated[
        str | None, typer.Option(help="Plane; apparent_temperature, radiance or display if left out.")
    ] = None,
    tolerance: Annotated[
        float | None, typer.Option(help="Largest difference allowed, in the plane's unit; beyond it exit code 3.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Compare a plane of two frames, and fail beyond a tolerance."""
    if tolerance is not None and not tolerance >= 0.0:
        raise InputError("command line", "--tolerance", tolerance, "not zero or more", "give kelvin, for example 0.1")
    found = compare_frames(first, second, plane)
    passed = tolerance is None or (found.largest <= tolerance and found.unmatched == 0)
    if as_json:
        print(json.dumps({**asdict(found), "tolerance": tolerance, "passed": passed}))  # noqa: T201
    else:
        unit = "" if found.unit == "1" else f" {found.unit}"
        console = Console(soft_wrap=True)
        console.print(
            f"{found.plane}: largest {found.largest:.4g}{unit}, 99 % within {found.p99:.4g}{unit}, "
            f"r.m.s. {found.rms:.4g}{unit}, mean {found.mean:+.4g}{unit} over {found.pixels} pixels"
            + (f"; {found.unmatched} see a surface in one only" if found.unmatched else ""),
            highlight=False,
        )
        if tolerance is not None:
            console.print("passed" if passed else f"failed: allowed {tolerance:g}{unit}", highlight=False)
    if not passed:
        raise typer.Exit(3)
