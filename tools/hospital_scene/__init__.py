"""The hospital scene's reconstruction: outlines, levels, sheets, and how they are written as GeoJSON."""
