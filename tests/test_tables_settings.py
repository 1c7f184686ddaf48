import json
from typing import Any

import pytest

from sensorsim.errors import InputError
from sensorsim.tables import PRESETS, BakeSettings, preset


@pytest.mark.parametrize(
    ("entry", "value"),
    [
        ("orientations", "icosphere43"),
        ("interpolation", "cubic"),
        ("lobes", -1800.0),
        ("lobes", 30.0),
        ("lobes", 43200.0),
        ("lobes", 7000.0),
        ("lobes", float("nan")),
        ("lobes", float("inf")),
        ("cell_size", 0.0),
        ("cell_size", float("nan")),
        ("cell_size", 6.0),
        ("precision", "float64"),
        ("slice_interval", 450.0),
        ("reflectances", ()),
        ("reflectances", (0.1, 0.1, 0.5, 0.7, 0.9)),
        ("reflectances", (0.1, 0.3, 0.5, 0.7, 1.1)),
        ("reflectances", (0.1, 0.3, 0.5, 0.7, float("nan"))),
        ("degree", 5),
        ("degree", -1),
        ("degree", 2.5),
        ("step", 0.0),
        ("step", -300.0),
        ("step", float("nan")),
        ("step", 7200.0),
        ("slice_interval", 400.0),
        ("slice_interval", 0.0),
        ("slice_interval", float("nan")),
        ("slice_interval", float("inf")),
        ("slice_interval", 2100.0),
        ("slice_interval", 172800.0),
        ("lead_in_days", -1.0),
        ("lead_in_days", float("inf")),
        ("lead_in_days", float("nan")),
    ],
)
def test_setting_that_cannot_be_used_is_refused_by_name_with_a_remedy(entry: str, value: Any) -> None:
    with pytest.raises(InputError, match=rf"bake settings: {entry} = .*; (use|give)"):
        BakeSettings(**{entry: value})


def test_presets_differ_in_effort_and_can_be_written_down() -> None:
    counts = {name: int("".join(filter(str.isdigit, chosen.orientations))) for name, chosen in PRESETS.items()}
    assert counts["draft"] <= counts["report"] < counts["standard"] < counts["reference"]
    for name in PRESETS:
        assert preset(name) is PRESETS[name]
        assert json.loads(json.dumps(preset(name).to_dict()))["orientations"] == PRESETS[name].orientations


def test_report_preset_is_the_reports_five_reflectances_and_quartic() -> None:
    chosen = preset("report")
    assert (len(chosen.reflectances), chosen.degree) == (5, 4)
    assert (chosen.orientations, chosen.interpolation, chosen.lobes) == ("report26", "closest", 0.0)


def test_unknown_preset_is_refused_with_those_that_are_known() -> None:
    with pytest.raises(InputError, match=r"preset = 'best'.*draft, report, standard, reference"):
        preset("best")
