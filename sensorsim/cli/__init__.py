"""The command line: `sensorsim COMMAND`."""

from sensorsim.cli.app import main

__all__ = ["main"]
