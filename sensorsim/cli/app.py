"""The commands under one name, and how errors leave the program: one line, exit code 2 for bad input, 1 otherwise."""

import sys

import typer
from rich.console import Console

from sensorsim.cli.bench import bench
from sensorsim.cli.capture import capture
from sensorsim.cli.diff import diff
from sensorsim.cli.effects import effects
from sensorsim.cli.gallery import gallery
from sensorsim.cli.info import info
from sensorsim.cli.render import render
from sensorsim.cli.scene import scene
from sensorsim.cli.serve import serve
from sensorsim.cli.study_accuracy import accuracy
from sensorsim.cli.study_city import city
from sensorsim.cli.study_effects import effects as study_effects
from sensorsim.cli.study_pictures import pictures
from sensorsim.cli.study_sensitivity import sensitivity
from sensorsim.cli.study_stability import stability
from sensorsim.cli.view import view
from sensorsim.cli.wall import wall
from sensorsim.errors import InputError, SensorsimError

app = typer.Typer(
    name="sensorsim",
    help="Physically based imagery of passive electro-optical sensors.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",  # of the kinds of help with panels the one that leaves units in [brackets] alone
)
for command in (render, view, serve, capture, bench, gallery, diff, effects, scene, wall, info):
    app.command()(command)
study = typer.Typer(help="What the model's choices are worth, measured.", no_args_is_help=True)
study.command("accuracy")(accuracy)
study.command("city")(city)
study.command("effects")(study_effects)
study.command("pictures")(pictures)
study.command("sensitivity")(sensitivity)
study.command("stability")(stability)
app.add_typer(study, name="study")


def main() -> None:
    """Run the command line."""
    try:
        app()
    except SensorsimError as error:
        Console(stderr=True, soft_wrap=True).print(f"sensorsim: {error}", style="red", markup=False, highlight=False)
        sys.exit(2 if isinstance(error, InputError) else 1)
