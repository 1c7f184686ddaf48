"""What the files of the hospital scene say of themselves."""

from hospital_scene.layout import COVER_DIAMETER, FOOT, LAWN, RAILROAD_AZIMUTH, SOIL, TRACK


def paragraphs(text: str) -> tuple[str, ...]:
    """Paragraphs of a text, one line each."""
    return tuple(" ".join(paragraph.split()) for paragraph in text.strip().split("\n\n"))


NOTES = paragraphs(f"""
Hospital scene of [Report1978], Fairborn, Ohio: a strip 2.5 by 0.75 miles along the railroad between Dayton and Xenia
Avenues.

The outlines are reconstructed from the report's text: its figures 4, 6 and 8 were not available. Relative places,
street lines and the railroad's azimuth of {RAILROAD_AZIMUTH:g} degrees are estimates; they are not survey data.

Columns A to K are those of the feature analysis sheets (figures 3, 5, 7), in feet as printed, null for a dash.
roof_word and wall_word are figure 10 as printed, null where it is silent; roof_word_used and wall_word_used are the
words chosen, with the reason in word_note.

Counting rule: a solid of n sides is n walls, a roof and a bottom, 2 n vertices and 6 n edges (edges once per
polygon); a plane polygon of v corners is 1 surface, v vertices, v edges. With it the report's printed totals come out
exactly.

Planes lie in layers above the base plane at 0 m: bare ground {SOIL:g} m, lawns and other areas {LAWN:g} m, roads and
tracks {TRACK:g} m. A depth buffer of 24 bits with its near plane n at 10 m resolves r^2 / (n 2^24) in depth at range
r: 0.6 m at 10 km. Layers 0.15 m apart lie 0.15 r / h apart along a ray from height h: 30 m at 10 km from a 50 m
tower, 0.75 m from 2 km up. Straight down they separate below 5 km. They are no thicker because height displaces an
edge: 0.15 m by 4 m of ground in a view 2 degrees below the horizon.

The terrain is flat. Roofs are flat, as the specification demands.

Interior conditions are judgements from each building's use; the report gives none per feature.
""")

LEVEL_NOTES = {
    "IA": paragraphs(f"""
IA: 10 solids with 89 sides and 2 planes with 10 vertices; the three point features are octagons. The hospital's
diameter is that of the convex cover of its outline at IIIB, {COVER_DIAMETER / FOOT:.0f} ft; the sheet gives none.
"""),
    "IIA": paragraphs("""
IIA: the totals close with 15 solids of 83 sides, one of them (6 sides) without a bottom, and 19 plane polygons with
119 vertices. The solid without a bottom is the upper part of the hospital, which stands on the lower part's roof.

The wood at the north-east end (feature 10 at IA, 62 at IIIB) has no row in figure 5 and is left out here.
"""),
    "IIIB": paragraphs("""
IIIB: 77 solids with 512 sides and 18 plane polygons with 131 vertices; the hospital's four heights are four solids
side by side, each with a bottom.

Column D gives 85 ft for all of 44-55. The large halls keep it, other structures have a top_ft of their own
(estimates), and the tracks (55) are a plane, whatever column D says.
"""),
}
