"""Image generator for a trainer's host."""

__all__: list[str] = []
