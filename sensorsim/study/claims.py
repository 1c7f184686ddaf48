"""The sentences of sections IV to 4.3 of [Report1978] that say what a picture shows, held against the model.

A sentence that does not come out is not forced: its claim carries the reason, and the relations between the measured
numbers that bear the reason out.
"""

from sensorsim.study import (
    claims_flir_afternoon,
    claims_flir_morning,
    claims_flir_seasons,
    claims_flir_winter,
    claims_levels,
    claims_lltv,
    claims_lltv_day,
)
from sensorsim.study.claims_evidence import Evidence
from sensorsim.study.claims_model import Claim, Outcome

CLAIMS: tuple[Claim, ...] = (
    *claims_flir_seasons.CLAIMS,
    *claims_flir_winter.CLAIMS,
    *claims_flir_morning.CLAIMS,
    *claims_flir_afternoon.CLAIMS,
    *claims_lltv.CLAIMS,
    *claims_lltv_day.CLAIMS,
    *claims_levels.CLAIMS,
)

LEFT_OUT = (  # section, content, why it is no claim
    ("4.1", "what the real sensors' photographs show, their resolution included", "not simulated pictures"),
    ("4.1", "which weather the real photographs and the simulated days share", "inputs"),
    ("4.2.1", "air and sky near 40 F in winter; about 65 F at 10 h in summer", "inputs; a clear sky is far colder"),
    (
        "4.2.1, 4.2.2",
        "which load is the main one, and that sun and air are about equal at 17 h",
        "causes, not pictures",
    ),
    ("4.2.2", "figure 20's outlines and sun positions", "inputs"),
    ("4.3", "that two quantities make the shades, sun and sky", "how the report's model is built"),
)


def evaluate_claim(claim: Claim, evidence: Evidence) -> Outcome:
    """Measure one claim."""
    return Outcome(claim=claim, numbers=dict(claim.measure(evidence)))


def evaluate_claims(evidence: Evidence) -> tuple[Outcome, ...]:
    """Measure all claims, in the order of the report's sections within each sensor."""
    return tuple(evaluate_claim(claim, evidence) for claim in CLAIMS)
