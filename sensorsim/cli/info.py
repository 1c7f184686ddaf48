"""`sensorsim info`: back end, renderer and versions, for bug reports."""

import json
import platform
from importlib.metadata import version

from rich.console import Console
from rich.table import Table

from sensorsim.cli.options import AsJson, Backend
from sensorsim.gpu import context_info, create_context
from sensorsim.version import __version__

PACKAGES = ("moderngl", "numpy", "numba", "scipy", "pvlib", "trimesh", "OpenEXR")


def info(backend: Backend = "auto", as_json: AsJson = False) -> None:
    """Print the OpenGL back end and renderer in use, and versions."""
    with create_context(backend) as ctx:
        graphics = context_info(ctx)
    figures = {
        "sensorsim": __version__,
        "python": platform.python_version(),
        "opengl": graphics,
        "packages": {name: version(name) for name in PACKAGES},
    }
    if as_json:
        print(json.dumps(figures, indent=2))  # noqa: T201
        return
    table = Table(show_header=False, box=None)
    for key, value in {"sensorsim": __version__, "python": figures["python"], **graphics}.items():
        for row in value.items() if isinstance(value, dict) else [(key, value)]:
            table.add_row(str(row[0]), str(row[1]))
    for name in PACKAGES:
        table.add_row(name, version(name))
    Console().print(table)
