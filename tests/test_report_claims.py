"""What sections IV to 4.3 of [Report1978] say of the pictures, each sentence a test; those that fail, apart."""

import json
from collections import Counter

import pytest

from sensorsim.study.claims import CLAIMS, LEFT_OUT, evaluate_claim, evaluate_claims
from sensorsim.study.claims_evidence import Evidence, gather_evidence
from sensorsim.study.claims_model import Claim, Outcome, more
from sensorsim.tables import BakeSettings

# A third of the default's time. What it costs, some tenths of a kelvin, the margins of the claims allow.
COARSE = BakeSettings(reflectances=(0.1, 0.5, 0.9), degree=2, step=600.0, slice_interval=1800.0)

COMES_OUT = [claim for claim in CLAIMS if not claim.reason]
DOES_NOT_COME_OUT = [claim for claim in CLAIMS if claim.reason]


@pytest.fixture(scope="module")
def evidence() -> Evidence:
    return gather_evidence(settings=COARSE)


def said(outcome: Outcome) -> str:
    numbers = "\n".join(f"    {name}: {value:.6g}" for name, value in outcome.numbers.items())
    relations = "; ".join(map(str, (*outcome.claim.relations, *outcome.claim.instead)))
    return f"section {outcome.claim.section}: {outcome.claim.content}\n  {relations}\n{numbers} [{outcome.claim.unit}]"


@pytest.mark.parametrize("claim", COMES_OUT, ids=lambda claim: claim.id)
def test_the_pictures_show_what_the_report_says(claim: Claim, evidence: Evidence) -> None:
    outcome = evaluate_claim(claim, evidence)
    assert outcome.holds, said(outcome)


@pytest.mark.parametrize("claim", DOES_NOT_COME_OUT, ids=lambda claim: claim.id)
def test_a_sentence_that_does_not_come_out_fails_for_its_recorded_reason(claim: Claim, evidence: Evidence) -> None:
    outcome = evaluate_claim(claim, evidence)
    assert not outcome.holds, f"comes out: drop its reason\n{said(outcome)}"
    assert claim.instead, "a reason without numbers cannot be wrong"
    assert outcome.reason_holds, f"the reason no longer holds: {claim.reason}\n{said(outcome)}"


def test_seasons_exchanged_break_the_claims_on_seasons(evidence: Evidence) -> None:
    """The claims can fail: with winter's pictures for summer's and summer's for winter's."""
    exchanged = {
        **evidence,
        ("IIIB", "winter"): evidence["IIIB", "summer"],
        ("IIIB", "summer"): evidence["IIIB", "winter"],
    }
    on_seasons = {claim.id: claim for claim in CLAIMS if "-warmest-of" in claim.id or "insensitive" in claim.id}
    assert len(on_seasons) == 3
    assert not any(evaluate_claim(claim, exchanged).holds for claim in on_seasons.values())


def test_hours_exchanged_break_the_claims_on_hours(evidence: Evidence) -> None:
    """The same with the low-light pictures of 10 and 16 h."""
    view = evidence["IIIB", "winter"]
    swap = {10.0: 16.0, 16.0: 10.0}
    pictures = {(s, swap.get(h, h) if s == "lltv" else h, c): p for (s, h, c), p in view.pictures.items()}
    exchanged = {**evidence, ("IIIB", "winter"): type(view)(world=view.world, pictures=pictures)}
    broken = {claim.id for claim in CLAIMS if claim.section == "4.3.2" and not evaluate_claim(claim, exchanged).holds}
    assert broken >= {
        "lltv-10h-cement-walls-unlit",
        "lltv-10h-east-brighter-than-west",
        "lltv-16h-cement-walls-face-sun",
        "lltv-16h-hospital-south-below-west",
        "lltv-hospital-reversed-from-10h-to-16h",
    }


def test_claims_are_told_apart_and_say_where_they_are_from() -> None:
    assert [name for name, count in Counter(claim.id for claim in CLAIMS).items() if count > 1] == []
    sections = {"IV", "4.1", "4.2.1", "4.2.2", "4.2.3", "4.3", "4.3.1", "4.3.2", "4.3.3"}
    assert {claim.section for claim in CLAIMS} == sections
    assert all(claim.content and claim.relations for claim in CLAIMS)
    assert all(content and why for _, content, why in LEFT_OUT)


def test_outcomes_are_plain_values(evidence: Evidence) -> None:
    outcomes = evaluate_claims(evidence)
    table = json.loads(json.dumps([outcome.to_dict() for outcome in outcomes], allow_nan=False))
    assert [row["id"] for row in table] == [claim.id for claim in CLAIMS]


def test_a_relation_is_strict_and_reads_as_it_is_said() -> None:
    relation = more("south", than="west", times=2.0, by=0.5)
    assert str(relation) == "south > 2 x west + 0.5"
    assert relation.holds({"south": 4.6, "west": 2.0})
    assert not relation.holds({"south": 4.5, "west": 2.0})
    assert str(more(0.0, than="cosine")) == "0.0 > cosine"
