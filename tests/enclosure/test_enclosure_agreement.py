"""Groups against the monodromy: those of published equations agree, others are disproved, larger ones aren't confirmed."""

from __future__ import annotations

import pytest
from build import Ground, as_problem, parametrize
from published import load

import kovacic
from kovacic import monodromy
from kovacic.enclosure.agreement import agrees_with_group, has_regular_places, verdict_on_matrices
from kovacic.galois import Group, GroupKind

OCTAHEDRAL = "(-135*x^2 + 115*x - 108)/(576*x^4 - 1152*x^3 + 576*x^2)"


def published_S(name: str) -> str:
    return next(entry.S for entry in load() if entry.id == name)


GROUPS = {
    "mu_3": "euler-13",
    "mu_4": "chebyshev-3",
    "dicyclic of order 8": "lame-half-B0",
    "dicyclic of order 12": "chebyshev-1/3",
    "SL(2,3)": "schwarz-II",
    "binary octahedral": "schwarz-IV",
    "SL(2,5)": "schwarz-VI",
    "G_a": "poschl-teller-2",
    "G_a extended by mu_2": "legendre-1",
    "G_a extended by mu_15": "kimura-red-2",
    "G_m": "euler-sqrt2",
    "Borel": "omega-alg-poles",
    "N(T)": "chebyshev-sqrt2",
    "SL2": "kimura-parity-fail-V",
}


@parametrize("name", sorted(GROUPS), ordinary=0, long=4, always=["SL(2,5)"])
def test_the_monodromy_of_published_equations_agrees_with_their_groups(name: str) -> None:
    solution = kovacic.solve(published_S(GROUPS[name]))
    assert str(solution.group) == name
    agreement = solution.compare_with_monodromy()
    assert agreement.verdict is True, agreement.reason


def claimed(kind: GroupKind, n: int | None = None) -> Group:
    return Group(kind, Ground.UNDETERMINED, n)


FINITE = [claimed(GroupKind.CYCLIC, n) for n in (1, 2, 3, 4, 24)]
FINITE += [claimed(GroupKind.DICYCLIC, n) for n in (2, 3, 6)]
FINITE += [claimed(kind) for kind in (GroupKind.TETRAHEDRAL, GroupKind.OCTAHEDRAL, GroupKind.ICOSAHEDRAL)]


@parametrize("name", sorted(GROUPS), ordinary=0, long=(0, 6))
def test_a_wrong_finite_group_is_disproved(name: str) -> None:
    S = published_S(GROUPS[name])
    matrices, fuchsian = monodromy(S), has_regular_places(as_problem(S))
    for group in FINITE:
        if str(group) != name:
            assert verdict_on_matrices(matrices, group, fuchsian).verdict is False, str(group)


@parametrize(
    ("id", "wrong"),
    [
        (
            "schwarz-II",
            [claimed(GroupKind.BOREL), claimed(GroupKind.MULTIPLICATIVE), claimed(GroupKind.INFINITE_DIHEDRAL)],
        ),
        (
            "kimura-parity-fail-V",
            [claimed(GroupKind.BOREL), claimed(GroupKind.IMPRIMITIVE, 2), claimed(GroupKind.ADDITIVE, 6)],
        ),
        ("chebyshev-sqrt2", [claimed(GroupKind.BOREL), claimed(GroupKind.MULTIPLICATIVE)]),
        (
            "kimura-red-2",
            [claimed(GroupKind.ADDITIVE, n) for n in (3, 5, 30, 7)] + [claimed(GroupKind.MULTIPLICATIVE)],
        ),
        ("legendre-1", [claimed(GroupKind.ADDITIVE, n) for n in (1, 4, 6)]),
        ("kovacic-c2-1", [claimed(GroupKind.CYCLIC, 4), claimed(GroupKind.TETRAHEDRAL)]),
    ],
    ordinary=1,
    long=3,
)
def test_a_wrong_infinite_group_is_disproved(id: str, wrong: list[Group]) -> None:
    solution = kovacic.solve(published_S(id))
    for group in wrong:
        assert agrees_with_group(solution, group).verdict is False, str(group)


def test_matrices_that_cannot_tell_say_so() -> None:
    airy = kovacic.solve("x").compare_with_monodromy()
    assert airy.verdict is None
    assert "trivial" in airy.reason
    larger = agrees_with_group(kovacic.solve(OCTAHEDRAL), claimed(GroupKind.SL2))
    assert larger.verdict is None
    assert "don't exclude every smaller group" in larger.reason


@parametrize(
    ("S", "larger"),
    [
        ("-3/(16*x^2)", claimed(GroupKind.MULTIPLICATIVE)),  # mu_4
        ("-3/(16*x^2)", claimed(GroupKind.ADDITIVE, 4)),
        ("1/x^2", claimed(GroupKind.BOREL)),  # G_m: the exponents have the square root of 5
        ("1/x^2", claimed(GroupKind.INFINITE_DIHEDRAL)),
        (published_S("poschl-teller-2"), claimed(GroupKind.BOREL)),  # G_a
        (published_S("kimura-red-2"), claimed(GroupKind.BOREL)),  # G_a extended by mu_15
        (published_S("lame-half-B0"), claimed(GroupKind.INFINITE_DIHEDRAL)),  # dicyclic of order 8
    ],
    ordinary=2,
)
def test_a_group_that_is_larger_than_the_monodromy_is_not_confirmed(S: str, larger: Group) -> None:
    found = agrees_with_group(kovacic.solve(S), larger)
    assert found.verdict is None
    assert "perhaps in a smaller group" in found.reason


@pytest.mark.slow
def test_no_published_equation_disagrees_with_its_group() -> None:
    verdicts = [kovacic.solve(entry.S).compare_with_monodromy().verdict for entry in load()]
    assert False not in verdicts
    assert verdicts.count(True) >= 110


def test_a_wrong_group_of_an_equation_with_an_algebraic_constant_is_disproved() -> None:
    assert agrees_with_group(kovacic.solve("-3/(16*(x-sqrt(2))^2)"), claimed(GroupKind.CYCLIC, 2)).verdict is False
