"""Comparison of the monodromy with the differential Galois group: a numerical test of the engine, with proofs in balls.

Verdicts:
- False: a proof that the group G isn't the claimed one.
- True: the matrices show everything about the claim that matrices can show (the reason says how much), and don't contradict it.
- None: the matrices can't decide, at this precision or at all.

Mathematics.  The monodromy group H is contained in G, and G is its Zariski closure where the equation is Fuchsian
[Schlesinger].  The proper algebraic subgroups of SL2(C) are reducible, or contained in N(T), or one of the three primitive
finite groups, and with A, B running through generators of H and their products,

    reducible   => tr [A, B] = 2 (a common eigenvector),            diagonal => [A, B] = 1,                     (1)
    within N(T) => [A^2, B^2] = 1 (squares are diagonal),           finite   => tr A = 2 cos(2 pi k/m), not 2 unless A = 1,

so a ball that excludes one of these excludes the groups on its left.  All three together prove that the group is SL2(C).
A finite group is enumerated: if the claim holds, the traces are those of G, and two elements are equal exactly when the trace
of their quotient is 2, which a ball that excludes the other traces decides; then H must have as many elements of each trace
as G.

References: M. van der Put and M. F. Singer, "Galois Theory of Linear Differential Equations" (2003), ch. 5; Kovacic (1986).
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from flint import acb, acb_mat, arb, fmpq, fmpz

from kovacic import derived
from kovacic.algebra.precision import working_precision
from kovacic.answer import Answer
from kovacic.enclosure.matrices import adjugate
from kovacic.enclosure.monodromy import LocalMonodromy, monodromy
from kovacic.enclosure.problem import NumericProblem, as_problem
from kovacic.enclosure.request import Accuracy
from kovacic.errors import InputError
from kovacic.galois import Group, GroupKind
from kovacic.limits import MOST_TRIALS, Limits

_LARGEST_POWER = 1 << 60  # FLINT takes exponents of a machine word, and balls of such powers say nothing
_TWO = acb(2)
_UNIT_MATRIX = acb_mat([[1, 0], [0, 1]])
_DIAGONAL = (GroupKind.CYCLIC, GroupKind.MULTIPLICATIVE)
_TRIANGULAR = (*_DIAGONAL, GroupKind.ADDITIVE, GroupKind.BOREL)
#: The eigenvalues are roots of unity of one order, which is the group's n.
_WITH_ROOTS_OF_UNITY = (GroupKind.CYCLIC, GroupKind.ADDITIVE)
_IMPRIMITIVE = (GroupKind.DICYCLIC, GroupKind.INFINITE_DIHEDRAL, GroupKind.IMPRIMITIVE)
#: The number of elements of trace 2 cos(2 pi angle) by the angle, at most 1/2.
_PRIMITIVE = {
    GroupKind.TETRAHEDRAL: {"0": 1, "1/2": 1, "1/4": 6, "1/3": 8, "1/6": 8},
    GroupKind.OCTAHEDRAL: {"0": 1, "1/2": 1, "1/4": 18, "1/3": 8, "1/6": 8, "1/8": 6, "3/8": 6},
    GroupKind.ICOSAHEDRAL: {"0": 1, "1/2": 1, "1/4": 30, "1/3": 20, "1/6": 20}
    | dict.fromkeys(("1/5", "2/5", "1/10", "3/10"), 12),
}


@dataclass(frozen=True)
class Agreement:
    """Verdict of `Solution.compare_with_monodromy`.

    Attributes
    ----------
    verdict : bool or None
        True, False (a proof that it isn't this group), or None, where the matrices can't tell.
    reason : str
        What the matrices showed, in a sentence.
    """

    verdict: bool | None
    reason: str


def agrees_with_group(
    answer: Answer,
    group: Group | None = None,
    *,
    accuracy: Accuracy | None = None,
    digits: int | None = None,
    limits: Limits | None = None,
) -> Agreement:
    """Compare the monodromy of y'' = S y with a group; see `Solution.compare_with_monodromy`.

    >>> import kovacic
    >>> from kovacic.galois import Ground
    >>> equation = kovacic.solve("-3/(16*x^2)")
    >>> agrees_with_group(equation)
    Agreement(verdict=True, reason='the monodromy group has 4 elements, with the traces of mu_4')
    >>> agrees_with_group(equation, Group(GroupKind.CYCLIC, Ground.RESIDUES, 2)).verdict
    False
    """
    group = derived.group(answer) if group is None else group
    if group is None:
        raise InputError("the equation is undecided, so there is no group to compare with")
    fuchsian = has_regular_places(as_problem(answer, constants=True))
    if not fuchsian and group.finite:
        return Agreement(False, "an irregular singular point makes the group infinite")
    return verdict_on_matrices(monodromy(answer, accuracy=accuracy, digits=digits, limits=limits), group, fuchsian)


def has_regular_places(problem: NumericProblem) -> bool:
    """True if all singular points, infinity among them, are regular."""
    num, den = problem.polynomials()
    # S = O(1/x^2) at infinity, and poles of order 2 at most [Fuchs].
    is_infinity_regular = num.degree() < 0 or num.degree() - den.degree() <= -2
    return is_infinity_regular and all(multiplicity <= 2 for _, multiplicity in problem.poles(64))


def verdict_on_matrices(local: tuple[LocalMonodromy, ...], group: Group, fuchsian: bool) -> Agreement:
    """The verdict from the matrices; `fuchsian` says that their Zariski closure is the group."""
    with working_precision(400):
        generators = [item.acb_mat() for item in local]
        angles = _angles(group)
        if angles is not None:
            return _by_enumeration(generators, group, angles)
        if not generators:
            return Agreement(None, "there is no finite singular point, so the monodromy is trivial")
        # The generators and their products in pairs; with one generator, itself and its square.
        longer = [generators[0] ** 2] if len(generators) == 1 else _products(generators)
        return _by_conditions([*generators, *longer], group, fuchsian)


def _inverse(m: acb_mat) -> acb_mat:
    """The inverse of a matrix of determinant 1."""
    return acb_mat(2, 2, adjugate(tuple(m.entries())))


def _angles(group: Group) -> Counter[Fraction] | None:
    """The numbers of elements with the eigenvalues exp(+-2 pi i angle), or None for an infinite or a large group."""
    if group.kind in _PRIMITIVE:
        return Counter({Fraction(angle): count for angle, count in _PRIMITIVE[group.kind].items()})
    if group.order is None or group.n is None or group.order > MOST_TRIALS:
        return None
    if group.kind is GroupKind.CYCLIC:
        return _angles_of_roots(group.n)
    # Dicyclic: the roots of unity of order 2 n, and as many elements of order 4.
    return _angles_of_roots(2 * group.n) + Counter({Fraction(1, 4): 2 * group.n})


def _angles_of_roots(n: int) -> Counter[Fraction]:
    """The angles of the n-th roots of unity, from 0 to 1/2: a root and its inverse are the eigenvalues of one matrix."""
    return Counter(Fraction(min(k, n - k), n) for k in range(n))


def _by_enumeration(generators: list[acb_mat], group: Group, angles: Counter[Fraction]) -> Agreement:
    """The verdict on a finite group with these angles: in the end no product with a generator is a new element."""
    traces = {angle: _trace_of_turn(angle) for angle in angles}
    elements = [_UNIT_MATRIX]
    found = Counter([Fraction(0)])
    # `elements` grows meanwhile.
    for candidate in (generator * element for element in elements for generator in generators):
        possible = _possible_angles(candidate, traces)
        if not possible:
            return Agreement(False, f"the monodromy group has an element whose trace isn't one of {group}")
        # If the claim holds, quotients of elements have the trace 2 only if they are 1.
        quotients = [candidate * _inverse(element) for element in elements]
        quotient_angles = [_possible_angles(quotient, traces) for quotient in quotients]
        equal = [
            quotient for quotient, found_angles in zip(quotients, quotient_angles, strict=True) if found_angles == [0]
        ]
        if not all(map(_may_be_identity, equal)):
            return Agreement(False, f"the monodromy group has a unipotent element, unlike {group}")
        may_be_equal = any(0 in found_angles for found_angles in quotient_angles)
        if len(possible) > 1 or (may_be_equal and not equal):
            return Agreement(None, "the matrices aren't known well enough to tell the elements apart")
        if not equal:
            elements.append(candidate)
            found[possible[0]] += 1
        if len(elements) > sum(angles.values()):
            return Agreement(False, f"the monodromy group has more elements than {group}")
    count = len(elements)
    if found != angles:
        return Agreement(False, f"the monodromy group has {count} elements, with other traces than {group}")
    plural = "element" if count == 1 else "elements"
    return Agreement(True, f"the monodromy group has {count} {plural}, with the traces of {group}")


def _possible_angles(m: acb_mat, traces: dict[Fraction, acb]) -> list[Fraction]:
    """The angles whose traces the matrix may have."""
    return [angle for angle, value in traces.items() if m.trace().overlaps(value)]


def _by_conditions(words: list[acb_mat], group: Group, fuchsian: bool) -> Agreement:
    """An infinite group (or a large one): the conditions (1), which a ball leaves open or disproves."""
    contradiction = _contradiction(words, group, fuchsian)
    if contradiction is not None:
        return Agreement(False, f"{contradiction} {group}")
    if group.kind is GroupKind.SL2:  # only a group in no proper algebraic subgroup is dense
        longer = [*words, *_commutators(words), *_products(words)]
        may_be_primitive = any(all(_may_be_in(m, kind) for m in longer) for kind in _PRIMITIVE)
        if _may_be_reducible(words) or _may_be_monomial(words) or may_be_primitive:
            return Agreement(None, "the monodromy matrices alone don't exclude every smaller group")
        return Agreement(True, "the monodromy matrices generate a group that is dense in SL2")
    if not fuchsian:
        return Agreement(True, f"the monodromy lies in {group} (irregular: it needn't be dense)")
    if _may_be_smaller(words, group):
        return Agreement(None, f"the monodromy lies in {group}, and perhaps in a smaller group")
    return Agreement(True, f"the monodromy lies in {group}, and in none of the smaller groups that were tried")


def _contradiction(words: list[acb_mat], group: Group, fuchsian: bool) -> str | None:
    """The condition of the group's kind that the matrices provably violate, in words that its name follows."""
    if group.kind in _TRIANGULAR and not _may_be_reducible(words):
        return "the monodromy matrices have no common eigenvector, unlike"
    if group.kind in _DIAGONAL and not _may_commute(words):
        return "the monodromy matrices don't commute, unlike"
    if group.kind in _IMPRIMITIVE and not _may_be_monomial(words):
        return "the squares of the monodromy matrices don't commute, unlike those of"
    if group.n is None or group.kind not in _WITH_ROOTS_OF_UNITY:
        return None
    if not all(_may_have_order(word, group.n) for word in words):
        return "an eigenvalue of a monodromy matrix isn't a root of unity of"
    # The monodromy of a Fuchsian equation is dense in its group, so n is the common multiple of the orders.
    if fuchsian and _is_proper_order(words, group.n):
        return "the eigenvalues of the monodromy matrices have a lower order than those of"
    return None


def _may_be_smaller(words: list[acb_mat], group: Group) -> bool:
    """True unless the matrices provably lie in none of the smaller groups that are tried.

    The eigenvalues of a smaller group are roots of unity, or it is abelian or reducible; of G_a extended by mu_n a smaller n
    was excluded, and finite subgroups are cyclic.  Of other groups nothing is tried.
    """
    if group.kind is GroupKind.ADDITIVE:
        n = group.n or 1
        return _may_commute(words) and (n >= _LARGEST_POWER or all(_may_be_identity(word**n) for word in words))
    if group.kind is GroupKind.BOREL:
        may_be_infinite = _may_commute(words)
    elif group.kind is GroupKind.INFINITE_DIHEDRAL:
        may_be_infinite = _may_be_reducible(words)
    else:
        may_be_infinite = group.kind is not GroupKind.MULTIPLICATIVE
    have_roots_of_unity = (any(_may_have_order(word, k + 1) for k in range(MOST_TRIALS)) for word in words)
    return may_be_infinite or all(have_roots_of_unity)


def _may_be_reducible(words: list[acb_mat]) -> bool:
    """True unless a commutator provably has another trace than 2, which it has beside a common eigenvector."""
    return all(c.trace().overlaps(_TWO) for c in _commutators(words))


def _may_commute(words: list[acb_mat]) -> bool:
    return all(map(_may_be_identity, _commutators(words)))


def _may_be_monomial(words: list[acb_mat]) -> bool:
    """True unless the squares, which are diagonal in a group that permutes two lines, provably don't commute."""
    return _may_commute([word**2 for word in words])


def _may_have_order(m: acb_mat, k: int) -> bool:
    """True if the eigenvalues may be k-th roots of unity."""
    return k >= _LARGEST_POWER or bool((m**k).trace().overlaps(_TWO))


def _is_proper_order(words: list[acb_mat], n: int) -> bool:
    """True if the orders of the eigenvalues, n-th roots of unity, provably have a common multiple less than n."""
    # The n/p-th powers are p-th roots of unity, whose real parts are at most cos(2 pi/p) unless they are 1.
    primes = [int(p) for p, _ in fmpz(n).factor()] if n <= MOST_TRIALS else []
    bounds = [(n // p, _trace_of_turn(Fraction(1, p)).real) for p in primes]
    return any(all((word**k).trace().real > bound for word in words) for k, bound in bounds)


def _products(words: list[acb_mat]) -> list[acb_mat]:
    return [a * b for a, b in combinations(words, 2)]


def _commutators(words: list[acb_mat]) -> list[acb_mat]:
    return [a * b * _inverse(a) * _inverse(b) for a, b in combinations(words, 2)]


def _may_be_identity(m: acb_mat) -> bool:
    return bool(m.overlaps(_UNIT_MATRIX))


def _may_be_in(m: acb_mat, kind: GroupKind) -> bool:
    """True if the matrix may be an element of this primitive group."""
    # In a finite group only +-1 have the traces +-2, and the squares of both are 1.
    if m.trace().overlaps(_TWO) or m.trace().overlaps(-_TWO):
        return _may_be_identity(m**2)
    return any(bool(m.trace().overlaps(_trace_of_turn(Fraction(angle)))) for angle in _PRIMITIVE[kind])


def _trace_of_turn(angle: Fraction) -> acb:
    """2 cos(2 pi angle)."""
    return acb(2 * arb.cos_pi_fmpq(fmpq(2 * angle.numerator, angle.denominator)))
