"""The package's version, which frames carry in their sidecars."""

__version__ = "0.1.0"
