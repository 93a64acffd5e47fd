"""Promises checked anew: what is true is confirmed, what is forged is not."""

import numpy as np
import pytest

from tween import Morph, certify, gallery, morph, paper_morph, sequence, triangulate, verify
from tween.measuring.certificate import Certificate
from tween.morphing.plan import Plan

DECIDED = ("linear", "slide", "metric", "angle")
PROVED = "proved by the morph, and its bounds checked anew"
CHECKED = "checked for every instant of playback"


def loosely_limited(plan: Plan) -> Plan:
    """The same with limits that let the angles at a vertex add up to more than 2 pi."""
    return plan._replace(low=plan.low + 0.3, high=plan.high + 0.3)


def unlimited(plan: Plan) -> Plan:
    none = np.full_like(plan.low, np.inf)
    return plan._replace(low=none, high=none)


def otherwise_hung(plan: Plan) -> Plan:
    return plan._replace(corners=np.roll(plan.corners, 1, axis=1))


def other_triangles(plan: Plan) -> Plan:
    n = len(plan.source)
    return plan._replace(corners=np.array([(5, (5 + i) % n, (6 + i) % n) for i in range(1, n - 1)]))


def other_target(plan: Plan) -> Plan:
    return plan._replace(target=plan.source)


def other_path(plan: Plan) -> Plan:
    return plan._replace(path="angle" if plan.path != "angle" else "linear")


def too_short(plan: Plan) -> Plan:
    return plan._replace(stop=0.9)


def too_late(plan: Plan) -> Plan:
    return plan._replace(leg_time=lambda t: t**2)


class Forged(Morph):
    """A morph that says of itself what is not true."""

    def __init__(self, m: Morph, forge=None, proof: str = "proved, and proved again") -> None:
        self.__dict__.update(m.__dict__)
        self.proof, self._forge = proof, forge

    def plans(self) -> list[Plan]:
        return [self._forge(plan) if self._forge else plan for plan in super().plans()]


def said(cert: Certificate) -> tuple[bool, str]:
    return cert.valid, cert.scope


@pytest.mark.parametrize("path", DECIDED)
def test_promises_that_are_true_are_confirmed_with_and_without_flips_and_limits(path) -> None:
    T = triangulate(gallery.curve("pretzel"))
    arrow, horseshoe = gallery.pair("arrow_to_horseshoe")
    for m in (
        morph(T, T.on_disk(), path=path),
        morph(*gallery.fan(), path=path, placement="root"),
        morph(arrow, horseshoe, path=path, strategy="paper"),
        morph(horseshoe, arrow, path=path, strategy="paper").reversed(),
    ):
        cert = certify(m, frames=20)
        assert said(cert) == (True, "morph"), cert
        assert cert.proof.startswith(PROVED)
        assert str(cert).startswith("valid at every time")
    assert np.isfinite(morph(*gallery.fan(), path="linear").plans()[0].low).any()


def test_where_the_angles_add_up_to_almost_2_pi_time_is_cut_finely() -> None:
    cert = certify(Forged(paper_morph(*gallery.fan(1.8))))
    assert said(cert) == (True, "morph")
    intervals = int(cert.proof.split("enclosed anew, in ")[1].split()[0])
    assert intervals > 64


def test_along_area_nothing_is_enclosed_and_the_weaker_word_is_used() -> None:
    cert = certify(morph(*gallery.fan(), path="area"))
    assert said(cert) == (True, "playback")
    assert cert.proof.startswith(CHECKED)
    assert "not confirmed: along 'area' angles are not enclosed here" in cert.proof


def test_a_morph_that_promises_nothing_is_not_asked() -> None:
    cert = certify(paper_morph(*gallery.fan(1.2)))
    assert said(cert) == (True, "playback")
    assert "an estimate" in cert.proof


def test_a_sequence_is_confirmed_leg_by_leg_through_holds_and_eases() -> None:
    arrow, horseshoe, ell = (gallery.curve(name) for name in ("arrow", "horseshoe", "ell"))
    s = sequence([arrow, horseshoe, ell], loop=True, hold=0.2)
    plans = s.plans()
    assert (plans[0].start, plans[-1].stop, len(plans)) == (0.0, 1.0, 3)
    assert said(certify(s, frames=30)) == (True, "morph")


# Forgeries


@pytest.mark.parametrize(
    ("forge", "words"),
    [
        (loosely_limited, "vertex 0 may reach 2 pi"),
        (unlimited, "vertex 0 may reach 2 pi"),
        (otherwise_hung, "hangs on no triangle before it"),
        (other_triangles, "not those in force"),
        (other_target, "is not what it is made of"),
        (other_path, "is not what it is made of"),
        (too_short, "does not cover the time from 0 to 1"),
        (too_late, "is not what it is made of"),
    ],
)
def test_a_forged_plan_is_refused_though_the_morph_is_valid(forge, words: str) -> None:
    cert = certify(Forged(morph(*gallery.fan(), path="linear"), forge))
    assert said(cert) == (True, "playback")
    assert cert.proof.startswith(CHECKED)
    assert "was not confirmed: " in cert.proof and words in cert.proof


@pytest.mark.parametrize("rho", [1.845, 1.9, 2.0, 4.0])
def test_a_forged_proof_of_a_broken_morph_is_refused(rho: float) -> None:
    m = Forged(paper_morph(*gallery.fan(rho), path="linear"))
    assert any(not verify(shape, m.source.triangles) for shape in m.frames(4001))
    cert = certify(m, frames=5)
    assert not cert.valid or (cert.scope == "playback" and "vertex 0 may reach 2 pi" in cert.proof)


def test_a_morph_that_is_broken_only_between_the_frames_looked_at_is_not_confirmed(monkeypatch) -> None:
    m = Forged(paper_morph(*gallery.fan(1.845)))
    monkeypatch.setattr("tween.measuring.refinement._MOST_ANGLES", 1)  # so that no frame is added
    cert = certify(m, frames=6)
    assert said(cert) == (True, "playback")
    assert "vertex 0 may reach 2 pi" in cert.proof


def test_a_morph_that_shows_other_shapes_than_it_says_is_not_confirmed() -> None:
    m = morph(*gallery.fan(), path="linear")
    other = Forged(morph(*gallery.fan(), path="metric"))
    other.plans = m.plans
    cert = certify(other)
    assert said(cert) == (True, "playback")
    assert "is not what it is made of" in cert.proof


@pytest.mark.parametrize("path", DECIDED)
@pytest.mark.parametrize("name", ["ess", "five_disks"])
def test_no_angle_of_a_morph_lies_above_its_enclosure(path, name: str) -> None:
    from tween.measuring import promise

    T = triangulate(gallery.curve(name))
    m = morph(T, T.on_disk(), path=path)
    (plan,) = m.plans()
    p = np.linspace(0.0, 0.9, 10)
    tops, sound = promise._tops(plan, promise._at_ends(plan), p, p + 0.1)
    assert sound.all()
    for share in np.linspace(0.0, 1.0, 5):
        t = np.clip(p + 0.1 * share, 0.0, 1.0)
        seen = promise._measured(m.at(1 - t if plan.first else t), plan.corners)
        assert (seen <= (1 - share) * tops[0] + share * tops[1] + 1e-9).all()
