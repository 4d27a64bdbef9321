"""Results: the structure that was found, and the evidence against others.  Frozen, comparable, picklable; no computing here.

The structures that the Galois group of y'' = S y can have, in the order in which they are tested [Kovacic 1986, sec. 1.2]:
reducible (case 1), imprimitive (case 2), and the three primitive finite groups (case 3); otherwise it is SL2(C) and there is
no Liouvillian solution.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, StrEnum

from kovacic.algebra.poly import Poly
from kovacic.algebra.ratfunc import RatFunc, logarithmic_derivative


class Status(StrEnum):
    """The verdict on the Liouvillian solutions of an equation; equal to its string."""

    LIOUVILLIAN = "liouvillian"
    NONE_EXISTS = "none"
    UNDECIDED = "undecided"


class Structure(Enum):
    """A structure of the Galois group under which Liouvillian solutions exist."""

    REDUCIBLE = "reducible"
    IMPRIMITIVE = "imprimitive"
    TETRAHEDRAL = "tetrahedral"
    OCTAHEDRAL = "octahedral"
    ICOSAHEDRAL = "icosahedral"

    # By identity: Enum's own hash is a Python function, called in each lookup.
    __hash__ = object.__hash__

    @property
    def case(self) -> int:
        """Kovacic's case."""
        return {"reducible": 1, "imprimitive": 2}.get(self._value_, 3)


class Rule(Enum):
    """The necessary conditions that can fail; the value is the message to the user."""

    RAMIFIED = "an irregular singular point is ramified, so no solution has a rational logarithmic derivative"
    LOGARITHM = (
        "a solution has a logarithm, so the group contains a unipotent element and is infinite and not imprimitive"
    )
    TOO_FEW_BRANCH_POINTS = "fewer than two places can be branch points of the square root of an invariant"
    IRREGULAR = "an irregular singular point makes the group infinite"
    EXPONENTS = "the exponent differences aren't those of a group of this kind"
    NOT_A_SQUARE = "the exponents at a place aren't rational over the field of its poles"

    __hash__ = object.__hash__


@dataclass(frozen=True)
class NecessaryCondition:
    """A structure is excluded by local data alone: `rule`, at the places with these factors or at "infinity"."""

    rule: Rule
    places: tuple[str, ...]


@dataclass(frozen=True)
class NoInvariant:
    """There is no rational invariant of this degree.

    Either the least valuations leave no room (prime None), or the linear system for the coefficients has nullity 0
    modulo `prime`, for invariants prod p^(v_p) P with deg P <= `degree`, expanded at the integer `point`.
    """

    invariant_degree: int
    prime: int | None = None
    point: int = 0
    degree: int = -1


@dataclass(frozen=True)
class NoRationalOmega:
    """There is no unique rational omega = R/D + P'/P.

    The exponents bound the degree of P by `degree`; a negative bound is proof enough (prime None).  Else, modulo `prime`, no
    possible expansion of omega at the least root of the factor `place` ("infinity" for infinity) is that of a rational
    function of the bounded degree.
    """

    degree: int
    prime: int | None = None
    place: str = ""


@dataclass(frozen=True)
class NoTerminatingSeries:
    """There is no rational omega = theta + P'/P: no theta that the exponents allow has a P.

    For `count` of these the degree of P would be a natural number, and for each of them the recurrence for the coefficients
    of P about a pole or the centre of all poles has two terms and meets an obstruction, or doesn't terminate.
    """

    count: int


Evidence = NecessaryCondition | NoInvariant | NoRationalOmega | NoTerminatingSeries


@dataclass(frozen=True)
class Exclusion:
    """A structure that the group provably doesn't have, and why.

    Attributes
    ----------
    structure : Structure
        The excluded structure.
    evidence : tuple
        Necessary conditions that fail, and invariants or an omega that don't exist.
    """

    structure: Structure
    evidence: tuple[Evidence, ...]


@dataclass(frozen=True)
class SemiInvariant:
    """A form f in the solutions with f'/f = theta + P'/P.

    Its linear factors are the solutions whose logarithmic derivatives are the conjugates of omega.

    Attributes
    ----------
    degree : int
        The degree of the form, and so the number of conjugates.
    theta : RatFunc
        Its poles are those of S, and infinity.
    P : Poly
        Its zeros are ordinary points.

    Examples
    --------
    >>> import kovacic
    >>> form = kovacic.solve("x^2 + 3").semi_invariant
    >>> print(form.degree, form.theta, form.P, form.logarithmic_derivative)
    1 x x (x**2 + 1)/x
    """

    degree: int
    theta: RatFunc
    P: Poly

    @property
    def logarithmic_derivative(self) -> RatFunc:
        """f'/f, the sum of the conjugates of omega."""
        return self.theta + logarithmic_derivative(self.P)


@dataclass(frozen=True)
class TerminatingSeries:
    """A solution y = exp(int theta) P with a P of too many terms to be written out, given by its recurrence.

    P = t^degree + ... + c t^lowest in steps of `step`, t = x - centre: the equation for P, P'' + 2 theta P' +
    (theta' + theta^2 - S) P = 0, is a relation between the coefficients of two powers of t, and determines it.

    Attributes
    ----------
    theta : RatFunc
        Its poles are at those of S, and at infinity.
    centre : Poly
        A constant.
    step, degree, lowest : int
        The powers of t in P are degree, degree - step, ..., lowest.

    Examples
    --------
    >>> import kovacic
    >>> series = kovacic.solve("x^2 + 2000000001").series
    >>> print(series.theta, series.centre, series.step, series.degree, series.lowest)
    x 0 2 1000000000 0
    """

    theta: RatFunc
    centre: Poly
    step: int
    degree: int
    lowest: int


@dataclass(frozen=True)
class RiccatiPolynomial:
    """The monic polynomial of omega = y'/y, minimal over C(x): `sum_k (-1)^k A_k/(P D^k) W^(m-k)`, with A_0 = P.

    Attributes
    ----------
    P, D : Poly
        P has its zeros at ordinary points, and D is the product of the poles of S.
    numerators : tuple of Poly
        A_0, ..., A_m.

    Examples
    --------
    >>> import kovacic
    >>> riccati = kovacic.solve("1/x - 3/(16*x^2)").riccati
    >>> riccati.degree, [str(c) for c in riccati.coefficients]
    (2, ['(-16*x + 1)/(16*x**2)', '-1/(2*x)', '1'])
    """

    P: Poly
    D: Poly
    numerators: tuple[Poly, ...]

    @property
    def degree(self) -> int:
        """The degree of omega over C(x): 1, 2, 4, 6 or 12."""
        return len(self.numerators) - 1

    @property
    def coefficients(self) -> tuple[RatFunc, ...]:
        """The coefficients of W^0, ..., W^m in lowest terms; the last one is 1."""
        m = self.degree
        lower = [RatFunc(self.numerators[k] * (-1) ** k, self.P * self.D**k) for k in range(m, 0, -1)]
        return (*lower, RatFunc(self.P.field.one))


@dataclass(frozen=True)
class Decision:
    """The engine's outcome: the structure that the group has, or None, and everything that was excluded before it.

    `semi_invariant` and `riccati` belong to omega; `invariant` is the rational form that showed the structure (None if
    omega was found without one); a `series` replaces them if P would be too long.  `undecided` is a sentence if a limit was
    reached: then only the exclusions are claimed.
    """

    structure: Structure | None
    exclusions: tuple[Exclusion, ...]
    invariant: SemiInvariant | None = None
    semi_invariant: SemiInvariant | None = None
    riccati: RiccatiPolynomial | None = None
    undecided: str | None = None
    series: TerminatingSeries | None = None

    @property
    def status(self) -> Status:
        if self.undecided is not None:
            return Status.UNDECIDED
        return Status.NONE_EXISTS if self.structure is None else Status.LIOUVILLIAN

    @property
    def case(self) -> int | None:
        """Kovacic's case, 1 to 3; None if there is no Liouvillian solution, or if that is undecided."""
        return None if self.structure is None else self.structure.case


@dataclass(frozen=True)
class Piece:
    """(a + b y)^exponent on a curve y^2 = h(x)."""

    exponent: int
    a: Poly
    b: Poly


@dataclass(frozen=True)
class CurveFunction:
    """A function f, the product of its pieces up to a function of x alone, on the curve y^2 = h.

    `multiple` * d log(y1/y2) = df/f + `rest` dx/y: (y1/y2)^multiple is f if the rest is 0; otherwise, since the rest is
    holomorphic, no power of y1/y2 is a function.
    """

    multiple: int
    h: Poly
    pieces: tuple[Piece, ...]
    rest: Poly


@dataclass(frozen=True)
class GroupClaim:
    """A claim about the group: its family, as in `kovacic.galois.GroupKind`, the parameter n, and its size.

    `order` is None for an infinite group; if it wasn't determined, the dimension is None as well.

    `form` is a rational form of degree 2 for a reducible group, if the decision has none.  For an imprimitive group on a curve
    of positive genus, `function` proves that it is finite or infinite; or `orders`, primes with orders modulo them, prove
    that it is infinite.
    """

    family: str
    n: int | None
    form: SemiInvariant | None = None
    orders: tuple[tuple[int, int], ...] = ()
    function: CurveFunction | None = None
    order: int | None = None
    dimension: int | None = None
