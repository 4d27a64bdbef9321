"""Domain of validity: where a solution is real, and which parameter values are excluded.

A formula needs a relation for each part that isn't real and finite at every real x.  Powers, roots and functions have
SymPy's values: x^(1/3), too, is complex for a negative x.  A function with a branch cut needs an argument u off the cut.
Where the argument has an i, as in Ei((1 + i) x), the part is complex and its conjugate is another part; then it is enough
that u isn't the branch point.

Reference: DLMF 4.2, 4.23, 4.37 (logarithms, inverse functions), 6.4 (Ei, Ci), 8.2 (gamma functions), 10.2, 10.25 (Bessel),
14.3 (Legendre), 15.2, 16.2 (hypergeometric functions), 19.2 (elliptic integrals), 25.12 (polylogarithms).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from typing import Any

import sympy
from sympy import Add, Dummy, GreaterThan, I, Mul, Ne, Pow, S, StrictGreaterThan, cos, exp, expand, gamma, sin
from sympy.simplify.fu import TR5, TR6
from sympy.solvers.inequalities import reduce_rational_inequalities

from kovacic.closed_form.check import letter_samples
from kovacic.closed_form.cuts import cut_of
from kovacic.general_solution.substitution import in_single_waves, size
from kovacic.general_solution.textbook import in_hyperbolic_functions, in_root
from kovacic.general_solution.zero import agree, by_parity, is_nowhere_zero, is_positive_polynomial
from kovacic.limits import manageable

Expr = Any  # SymPy publishes no types


@dataclass(frozen=True)
class Validity:
    """`real`: relations that make every part of the formula real and finite; `exceptions`: expressions that must not be zero.

    An exception depends on parameters alone: where it is zero a part has a zero denominator, or the two solutions of a
    general solution become dependent, so that other formulas hold.  If a part is complex (`has_real_parts` is false), as
    sqrt(k) for a k that is assumed to be negative, the relations make the formula valid, but not necessarily real.
    """

    real: tuple[Expr, ...]
    exceptions: tuple[Expr, ...]
    has_real_parts: bool = True

    @property
    def claim(self) -> str:
        """ "real and valid", or only "valid" if a part of the formula isn't real."""
        return "real and valid" if self.has_real_parts else "valid"

    def __bool__(self) -> bool:
        """True if there are any requirements."""
        return bool(self.real or self.exceptions)

    def __str__(self) -> str:
        """`x > 0, c**2 - 4*k*m != 0`."""
        real = (inequality(r.lhs) if isinstance(r, Ne) else str(r) for r in self.real)
        implied = _never_zero_beside(r.lhs for r in self.real if isinstance(r, StrictGreaterThan))
        return ", ".join([*real, *(inequality(e) for e in self.exceptions if e not in implied)])


#: Signs that an expression may have; "i" is that of numbers that aren't real.
POSITIVE, NOT_NEGATIVE, NONZERO, ANY = map(frozenset, ("+", "0+", "-+i", "-0+i"))
#: The sign of -u, where it isn't that of u.
_OPPOSITE = {"-": "+", "+": "-"}


@dataclass(frozen=True)
class Need:
    """The signs that an expression must have: u > 0, u >= 0 or u != 0.

    Of two needs of one expression the common signs are left: u > 0 for u >= 0 and u != 0.
    """

    u: Expr
    signs: frozenset[str]

    @property
    def relation(self) -> Expr:
        """As SymPy writes it."""
        kind = {POSITIVE: StrictGreaterThan, NOT_NEGATIVE: GreaterThan, NONZERO: Ne}[self.signs]
        return kind(self.u, 0, evaluate=False)

    def __str__(self) -> str:
        return str(self.relation)

    def xreplace(self, values: Mapping[Expr, Expr]) -> Need:
        """The need of the expression with other letters."""
        return replace(self, u=self.u.xreplace(values))

    @cached_property
    def holds(self) -> bool:
        """True if it is seen to hold for all real values of the letters.

        As exp(x) + 1 != 0, x^2 - x + 1 > 0 and x + sqrt(x^2 + 1) > 0 do.
        """
        e = self.u.xreplace(_real_letters(self.u))
        if _signs_of(self.u) <= self.signs:
            return True
        if e.has(I):
            return any(part.is_nonzero for part in expand(e).as_real_imag())
        signed = (e, -e)[: 1 + (self.signs == NONZERO)]
        if any(is_positive_polynomial(p, or_zero="0" in self.signs) for p in signed):
            return True
        roots, others = sympy.sift(Add.make_args(e), lambda part: part.is_Pow, binary=True)
        is_root = len(roots) == 1 and roots[0].exp == S.Half
        return is_root and bool(expand(roots[0].base - Add(*others) ** 2).is_positive)  # sqrt(g) > |f|

    @property
    def factors(self) -> list[Need]:
        """That of each factor, for u != 0."""
        return [Need(f, NONZERO) for f in _factors(self.u)]

    def parts(self, known: Callable[[Expr], frozenset[str]]) -> Iterator[Need]:
        """Needs that are equivalent to it for real roots and powers, of factors whose signs are `known`, and of the others.

        a^2 - x^2 > 0 for 1 - x^2/a^2 > 0; k > 0 and x > 0 for sqrt(k)*sqrt(x)*exp(x/2) > 0, and for k*x > 0 beside k >= 0;
        v != 0 for v^2 > 0 and |v| > 0; k != 0 and x - a != 0 for k*(a - x) != 0; h >= 0 for h*k >= 0 beside k > 0;
        u > 0 for u >= 0 where no factor of u is zero.
        """
        if self.signs == NONZERO:
            yield from self.factors
            return
        u, signs = _as_a_product(self.u), self.signs
        if any(all("0" not in known(f) for f in factors) for factors in ([u], ZeroSet(u).factors)):
            signs = POSITIVE
        rest = []
        for f in Mul.make_args(u.as_content_primitive()[1]):
            base, exponent = f.as_base_exp() if f.is_Pow else (f, S.One)
            is_real_root = not (exponent.is_integer or exponent.free_symbols)  # of what isn't negative
            if isinstance(f, sympy.Abs) or exponent.is_even:
                if signs == POSITIVE and not exponent.is_negative:
                    yield Need(f.args[0], NONZERO)
            elif Need(f, POSITIVE).holds:
                continue
            elif is_real_root or known(base) <= NOT_NEGATIVE:
                yield Need(base, signs)
            else:
                rest.append(base if exponent.is_odd else f)
        yield Need(Mul(*rest), signs)


def needed_for(
    formulas: Iterable[Expr], x: Expr, exceptions: Iterable[Expr] = (), others: Iterable[Need] = ()
) -> Validity:
    """The requirements of formulas, part by part, and others; `exceptions` are those of the pair of solutions in them."""
    value, roots = _without_even_roots(sympy.Tuple(*formulas), x)
    # The bounds of an integral may be infinite; SymPy can't tell whether a sum over roots is real.
    plain = value.xreplace({total: Dummy() for total in value.atoms(sympy.RootSum)})
    numbers = (node for node in sympy.preorder_traversal(plain) if node.is_number)
    has_real_numbers = all(number.is_extended_real for number in numbers)
    # atan and asinh have their cuts on the imaginary axis, where a root of something negative lies
    cuts = (_positive(cut_of(e)) for e in value.atoms(sympy.atan, sympy.asinh) if e.has(*roots))
    needs = [need.xreplace(roots) for need in chain(needs_of(value), *cuts, others)]
    exceptions = [e for e in exceptions if not is_nowhere_zero(e)]
    found = _stated(needs, x, exceptions, has_real_parts=has_real_numbers)
    if found is None:  # no x and letters make all parts real: it is a solution between the branch points
        apart = [n for need in needs for n in ([need] if need.signs == NONZERO else _nonzero(need.u))]
        found = _stated(apart, x, exceptions, has_real_parts=False)
    assert found is not None
    return found


def _stated(needs: Sequence[Need], x: Expr, exceptions: Sequence[Expr], *, has_real_parts: bool) -> Validity | None:
    """The needs and exceptions that have to be stated; None if no x and letters satisfy the needs."""
    # where letters are zero other formulas hold, also for k beside k >= 0
    split = [part for need in needs for part in (need.factors if need.signs == NONZERO else [need])]
    of_letters, others = sympy.sift(split, lambda n: n.signs == NONZERO and not n.u.has(x), binary=True)
    of_formula = _simplified(others)
    if of_formula is None:
        return None
    more, of_x = sympy.sift(of_formula, lambda n: n.signs == NONZERO and not n.u.has(x), binary=True)
    zeros = [*(factor for need in (*of_letters, *more) for factor in ZeroSet(need.u).factors), *exceptions]
    if has_real_parts:
        known = [need.u for need in of_x if need.signs != NONZERO]
        zeros = [part for zero in zeros for part in _for_real_letters(zero, known)]
    # k >= 0 of the formula is k > 0 beside an exception k, which has to stay: for k = 0 another formula holds
    said = _never_zero_beside(need.u for need in of_x if need.signs == POSITIVE)
    unsaid = independent_exceptions(zero for zero in zeros if zero not in said)
    whole = _simplified([*of_x, *(Need(zero, NONZERO) for zero in zeros)])
    if whole is None:
        return None
    implied = _never_zero_beside(need.u for need in whole if need.signs == POSITIVE)
    # x != 0 follows from a x > 0, but not from x >= 0
    needs = [_of_cosine(n) for n in whole if n.signs != NONZERO or (n.u.has(x) and n.u not in implied)]
    real = _in_one_interval({(need.signs, expand(need.u)): need for need in needs}.values(), x)
    return None if real is None else Validity(real, unsaid, has_real_parts)


def _simplified(needs: Iterable[Need]) -> list[Need] | None:
    """Shorter needs that are equivalent to these together; None if that is impossible."""
    joined: dict[Expr, frozenset[str]] = {}
    for need in needs:
        joined[need.u] = joined.get(need.u, ANY) & need.signs

    def known(u: Expr) -> frozenset[str]:
        opposite = {_OPPOSITE.get(sign, sign) for sign in joined.get(-u, ANY)}
        return joined.get(u, ANY) & opposite & _signs_of(u)

    if not all(map(known, joined)):
        return None
    parts = (part for u, signs in joined.items() for part in Need(u, signs).parts(known))
    shorter = [part for part in dict.fromkeys(parts) if not part.holds]
    return shorter if shorter == [*needs] else _simplified(shorter)


def _signs_of(u: Expr) -> frozenset[str]:
    """The signs that u may have by what is assumed of its letters, which are real."""
    e = u.xreplace(_real_letters(u))
    facts = {"-": e.is_extended_negative, "0": e.is_zero, "+": e.is_extended_positive, "i": not e.is_extended_real}
    return frozenset(sign for sign, fact in facts.items() if fact is not False)


def _factors(u: Expr) -> list[Expr]:
    """The factors, without signs and powers with positive exponents: where one is zero, so is u."""
    powers = (f.as_base_exp() for f in Mul.make_args(u) if not f.is_number)
    factors = [base if exponent.is_positive else base**exponent for base, exponent in powers]
    return [-f if f.could_extract_minus_sign() else f for f in factors]


def _as_a_product(u: Expr) -> Expr:
    """u with a product in place of a sum of fractions or of hyperbolic tangents, whose factors' signs may be known."""
    if u.has(sympy.tanh):  # 1 - tanh(x)^2 = 4 exp(2 x)/(exp(2 x) + 1)^2
        u = sympy.factor(sympy.together(expand(u.rewrite(sympy.exp))))
    if u.is_Add and u.is_rational_function() and any(p.exp.is_negative for p in u.atoms(Pow)):
        u = sympy.factor_terms(sympy.together(u))
    return u


def _never_zero_beside(positive: Iterable[Expr]) -> set[Expr]:
    """What isn't zero where expressions are positive: these, and their factors."""
    return {factor for u in positive for factor in (u, *_factors(u), *ZeroSet(u).factors)}


def _for_real_letters(zero: Expr, known: Collection[Expr]) -> Sequence[Expr]:
    """The factors that may be zero for real letters: k for sympy.sinh(k), and r for exp(sqrt(r)) - 1 where r >= 0 is known.

    Nothing for 1/gamma(1 + sqrt(r)), and r for 1/gamma(sqrt(r)): a root isn't negative, and no pole if it isn't real.
    """
    is_pole = gamma_zeros(zero) is not None
    powers = (p for p in zero.atoms(Pow) if p.exp == S.Half and (is_pole or p.base in known))
    roots = {p: Dummy(nonnegative=True) for p in powers}
    letters = roots | _real_letters(zero)
    own = {letter: e for e, letter in letters.items()}
    found: list[Expr] = []
    for factor in ZeroSet(zero.xreplace(letters)).factors:
        pole = expand((1 / factor).args[0]) if is_pole else factor
        root = next((s for s in roots.values() if (pole / s).is_positive), factor)
        found += ZeroSet(root.xreplace(own)).factors
    return found if sum(map(size, found)) < size(zero) else (zero,)


def _real_letters(e: Expr) -> dict[Expr, Expr]:
    """Real symbols for those that aren't known to be real or not."""
    return {s: sympy.Symbol(s.name, real=True) for s in e.free_symbols if s.is_real is None}


def _without_even_roots(value: Expr, x: Expr) -> tuple[Expr, dict[Expr, Expr]]:
    """The value with real letters s for roots of letters in which it is even, and the roots.

    It is real for a negative radicand as well: a power series in s^2 with real coefficients, as 2F1(a + s, a - s; c; z) is,
    and solutions that are 1 and 0 at a point, whose slopes are 0 and 1.
    """
    roots = {}
    for radicand in {p.base for p in value.atoms(Pow) if (2 * p.exp).is_odd and p.free_symbols and not p.has(x)}:
        s = Dummy(real=True)
        in_s = in_root(value, radicand, s)
        other = in_s.xreplace({s: -s})
        small = {letter: 1 / (number + 1) for letter, number in next(letter_samples(in_s.free_symbols)).items()}
        equal = (agree(u.xreplace(small), v.xreplace(small)) for u, v in zip(in_s, other, strict=True))
        if in_s == other or (in_s.has(sympy.hyper) and all(equal)):
            value = in_s
            roots[s] = sympy.sqrt(radicand)
    return value, roots


def _in_one_interval(needs: Collection[Need], x: Expr) -> tuple[Expr, ...] | None:
    """x > 0 for x != 0, 1 + 1/x > 0, x + 1 > 0, without needs that hold there; None if no interval satisfies all."""
    rational, others = sympy.sift(needs, lambda need: _is_over_Q(need.u, x), binary=True)
    said = [need.relation.reversedsign if need.u == -x else need.relation for need in needs]  # x < 0
    if not rational:
        return tuple(said)
    t = Dummy(real=True)
    where = reduce_rational_inequalities([[need.relation.xreplace({x: t}) for need in rational]], t, relational=False)
    if where.measure == 0:
        return None
    if len(needs) == 1 or not isinstance(where, sympy.Interval) or where.has(sympy.CRootOf):
        return tuple(said)
    a, b = where.start, where.end
    ends = [t > a if where.left_open else t >= a, t < b if where.right_open else t <= b]
    bounds = [bound for end in ends if (bound := end.xreplace({t: x})) != sympy.true]  # as x > -1 for a positive x is
    p = Dummy(positive=True)
    inside = a + p if b == sympy.oo else b - p if a == -sympy.oo else (a + b * p) / (1 + p)
    places = (inside, *(end for end in (a, b) if end in where))
    others = [need for need in others if not all(need.xreplace({x: place}).holds for place in places)]
    is_shorter = len(bounds) < len(rational)
    return (*(bounds if is_shorter else [need.relation for need in rational]), *(need.relation for need in others))


def _is_over_Q(e: Expr, x: Expr) -> bool:
    """True for a rational function of x alone with rational coefficients."""
    parts = sympy.preorder_traversal(e)
    return bool(e.is_rational_function(x)) and all(part.is_Rational or part.has(x) for part in parts)


def _of_cosine(need: Need) -> Need:
    """cos(u) != 0 for (1 + sin(u))*(1 - sin(u)) > 0, and other products of sums with waves as one wave."""
    if need.signs != POSITIVE or not need.u.has(sin, cos):
        return need
    product = expand(need.u)
    powers = (square.as_base_exp() for square in (TR5(product), TR6(product)))
    of_one_wave = in_single_waves(product).as_content_primitive()[1]
    shorter = Need(min(need.u, of_one_wave, key=sympy.count_ops), POSITIVE)
    return next((Need(base, NONZERO) for base, exponent in powers if exponent == 2), shorter)


# ---------------------------------------------------------------------------------------------------------- zero sets


@dataclass(frozen=True)
class ZeroSet:
    """The values of letters for which `expression` vanishes: it is empty, and false, without `factors`.

    >>> k, n = sympy.symbols("k n")
    >>> print(ZeroSet(k**2 * exp(k)), "|", ZeroSet(1 / gamma(-n)), "|", ZeroSet(sympy.sin(k) / k))
    k = 0 | n is one of 0, 1, 2, ... | sin(k) = 0 and k != 0
    """

    expression: Expr

    @cached_property
    def factors(self) -> tuple[Expr, ...]:
        """The factors with letters that may be zero, each once, without powers and signs."""
        found = []
        for factor in _factors_with_zeros(self.expression):
            # the inverse of a gamma function is zero at its poles
            is_below = factor.is_Pow and factor.exp.is_negative and not factor.has(gamma)
            if factor.free_symbols and not is_below and not _has_no_zero(factor):
                found.append(-factor if factor.could_extract_minus_sign() else factor)
        return tuple(dict.fromkeys(found))

    def __bool__(self) -> bool:
        return bool(self.factors)

    def __str__(self) -> str:
        return self.said()

    def said(self, answer: Expr = S.Zero) -> str:
        """`equation`, and that it is defined: sin(k)/k is 1 at k = 0, where its factor sin(k) vanishes."""
        below = Mul.make_args(sympy.fraction(sympy.together(self.expression))[1])
        product = Mul(*self.factors)
        bases = (factor.as_base_exp()[0] for factor in below)
        guarding = (ZeroSet(b).factors for b in bases if b.free_symbols and _where_zero(product, b) == 0)
        return " and ".join([self.equation(answer), *(f"{Mul(*zeros)} != 0" for zeros in guarding if zeros)])

    def equation(self, answer: Expr = S.Zero) -> str:
        """`k = 0`; in hyperbolic functions if the answer has these."""
        left = Mul(*self.factors)
        if poles := gamma_zeros(left):
            return f"{poles[0]} is one of 0, {poles[1]}, {2 * poles[1]}, ..."
        if answer.has(sympy.sinh, sympy.cosh):
            factors = Mul.make_args(in_hyperbolic_functions(left))
            left = Mul(*(factor for factor in factors if not is_nowhere_zero(factor)))
        return f"{left} = 0"


def gamma_zeros(e: Expr) -> tuple[Expr, int] | None:
    """(n, 1) for 1/gamma(-n), which is zero at 0, 1, 2, ...; (n, -1) for 1/gamma(n); None for other expressions."""
    if not isinstance(1 / e, gamma):
        return None
    u = min((1 / e).args[0], sympy.together((1 / e).args[0]), key=size)
    return (-u, 1) if u.could_extract_minus_sign() else (u, -1)


def inequality(e: Expr) -> str:
    """`k != 0`, or `n is none of 0, 1, 2, ...`."""
    poles = gamma_zeros(e)
    return f"{poles[0]} is none of 0, {poles[1]}, {2 * poles[1]}, ..." if poles else f"{e} != 0"


def independent_exceptions(exceptions: Iterable[Expr]) -> tuple[Expr, ...]:
    """The exceptions without c + m and 1/gamma(c + m), m an integer, beside sin(pi c); 1/gamma(c) for c and 1/gamma(c + 1)."""
    exceptions = tuple(dict.fromkeys(exceptions))
    for inverse in [e for e in exceptions if isinstance(1 / e, gamma)]:
        c = sympy.expand((1 / inverse).args[0] - 1)
        others = [e for e in exceptions if not sympy.cancel(e / c).is_number]
        if len(others) < len(exceptions):
            exceptions = tuple(1 / gamma(c) if e == inverse else e for e in others)
    periodic = [e.args[0] / sympy.pi for e in exceptions if isinstance(e, sympy.sin)]

    def is_implied(e: Expr) -> bool:
        number = (gamma_zeros(e) or (e,))[0]
        return any(sympy.cancel(number - sign * c).is_Integer for c in periodic for sign in (1, -1))

    return tuple(dict.fromkeys(e for e in exceptions if not is_implied(e)))


def _factors_with_zeros(zero: Expr) -> Iterator[Expr]:
    """The factors, and b for b^c, which is zero for b = 0 alone if c is positive.

    With real a and b, a - b in the place of exp(a) - exp(b), and 2*n + 1 in that of 3*3^(2*n) - 1.
    """
    if manageable(zero):
        above, below = sympy.fraction(sympy.together(zero))
        above /= Mul(*(f for f in Mul.make_args(below) if isinstance(f, gamma)))  # 0 at its poles
        zero = min(map(sympy.factor, (above, in_single_waves(above))), key=size)
    if zero.has(exp):
        zero = sympy.powsimp(zero, deep=True, combine="exp")  # exp(a) exp(-b)
    for factor in Mul.make_args(zero):
        terms = Add.make_args(factor.rewrite(exp) if isinstance(factor, sympy.sinh) else factor)
        exponent = sympy.expand_log(sympy.log(-terms[0] / terms[1])) if len(terms) == 2 else I
        if factor.is_Pow and not isinstance(factor, exp) and not factor.exp.is_nonpositive:
            yield from _factors_with_zeros(factor.base)
        elif exponent.is_real and all(f.is_number for f in exponent.atoms(sympy.log)):
            yield from _factors_with_zeros(exponent)
        else:
            yield factor


def _where_zero(e: Expr, base: Expr) -> Expr:
    """The value of e where the base is zero: at the zero of a letter in which the base is linear with a number before it."""
    for letter in base.free_symbols:
        slope = base.diff(letter)
        if slope.is_number:
            return e.subs(letter, sympy.expand(letter - base / slope))
    return e.subs(base, 0)


def _has_no_zero(factor: Expr) -> bool:
    """True if it is seen for even and for odd integers, or in hyperbolic functions; gamma functions have no zeros."""
    cases = Mul(*by_parity(factor))
    forms = (cases, in_hyperbolic_functions(factor)) if factor.has(exp) else (cases,)
    parts = (Mul.make_args(form) for form in forms)
    return any(all(isinstance(part, gamma) or is_nowhere_zero(part) for part in product) for product in parts)


# ------------------------------------------------------------------------------------------------------ part by part


def needs_of(e: Expr) -> Iterator[Need]:
    """Needs that make an expression real and finite.

    >>> x = sympy.Symbol("x")
    >>> [str(need) for need in needs_of(1 / sympy.log(x))]
    ['x > 0', 'Ne(log(x), 0)']
    """
    if isinstance(e, sympy.Integral):
        # the integrand at x, where it is integrated up to x; an end without x may be a singular point of it
        variable, upper = e.limits[0][0], e.limits[0][-1]
        if upper.free_symbols:
            yield from needs_of(e.function.subs(variable, upper))
        return
    if isinstance(e, sympy.RootSum):
        # the terms at the real roots: the others come in pairs, and roots with parameters aren't known
        if e.poly.domain.is_ZZ or e.poly.domain.is_QQ:
            for root, _ in sympy.real_roots(e.poly, multiple=False):
                yield from needs_of(e.fun(root))
        return
    for argument in e.args:
        yield from needs_of(argument)
    if e.func in _NEEDS:
        yield from _NEEDS[e.func](e, e.args[-1])


def _of_power(e: Expr, exponent: Expr) -> list[Need]:
    """The need of a power with a real and finite base and exponent."""
    if e.base.is_number or (exponent.is_nonnegative and exponent.is_integer):
        return []
    if exponent.is_integer:
        return [Need(e.base, NONZERO)]
    return (_not_negative if exponent.is_Rational and exponent > 0 else _positive)(e.base)


def _positive(u: Expr) -> list[Need]:
    """u > 0, for a cut from 0 to -oo; u != 0, the branch point, for an argument with an i."""
    return _nonzero(u) if u.has(I) else [Need(u, POSITIVE)]


def _not_negative(u: Expr) -> list[Need]:
    """u >= 0, but nothing for an argument with an i."""
    return [] if u.has(I) else [Need(u, NOT_NEGATIVE)]


def _nonzero(u: Expr) -> list[Need]:
    """u != 0, without numerical factors, and without the denominator, which has needs of its own."""
    factors = Mul.make_args(sympy.numer(u).as_content_primitive()[1])
    return [Need(Mul(*(factor for factor in factors if not factor.is_number)), NONZERO)]


def _of_elliptic_integral(e: Expr, last: Expr) -> list[Need]:
    """F, E and Pi up to phi, or pi/2: there 1 - m sin(phi)^2, and 1 - n sin(phi)^2, have no zero."""
    moduli = [last] + [e.args[0]] * isinstance(e, sympy.elliptic_pi)
    square = sin(e.args[-2]) ** 2 if len(e.args) > len(moduli) else 1
    return [need for m in moduli for need in _positive(1 - m * square)]


def _of_hypergeometric(e: Expr, u: Expr) -> list[Need]:
    """pFq: a polynomial, or entire for p <= q, with a cut from 1 on for p = q + 1, from 0 on for p > q + 1."""
    defined = [Need(1 / gamma(c), NONZERO) for c in e.bq if c.free_symbols]  # poles at 0, -1, ...
    is_polynomial = any(a.is_integer and a.is_nonpositive for a in e.ap)
    cut = 1 - u if len(e.ap) == len(e.bq) + 1 else -u
    return defined if is_polynomial or len(e.ap) <= len(e.bq) else [*_positive(cut), *defined]


#: The need of a power or a function e with the last argument u.
_NEEDS: dict[Any, Callable[[Expr, Expr], list[Need]]] = {
    Pow: _of_power,
    # inverse functions, and those with poles
    **dict.fromkeys((sympy.asin, sympy.acos), lambda e, u: _not_negative(cut_of(e))),
    sympy.acosh: lambda e, u: _not_negative(u - 1),
    **dict.fromkeys((sympy.tan, sympy.sec), lambda e, u: _nonzero(cos(u))),
    **dict.fromkeys((sympy.cot, sympy.csc), lambda e, u: _nonzero(sin(u))),
    **dict.fromkeys((sympy.coth, sympy.csch, sympy.Ei), lambda e, u: _nonzero(u)),
    # with a cut
    **dict.fromkeys(
        (sympy.log, sympy.Ci, sympy.expint, sympy.uppergamma, sympy.lowergamma, sympy.polylog, sympy.atanh),
        lambda e, u: _positive(cut_of(e)),
    ),
    **dict.fromkeys((sympy.bessely, sympy.besselk), lambda e, u: _positive(u)),
    **dict.fromkeys((sympy.elliptic_k, sympy.elliptic_e, sympy.elliptic_f, sympy.elliptic_pi), _of_elliptic_integral),
    # J_n(u) is (u/2)^n times an entire function; y_n(u) is rational in u beside waves for an integer n
    **dict.fromkeys(
        (sympy.besselj, sympy.besseli, sympy.jn), lambda e, u: [] if e.args[0].is_integer else _positive(u)
    ),
    sympy.yn: lambda e, u: _nonzero(u) if e.args[0].is_integer else _positive(u),
    # polynomials for an integer n; else u > -1
    **dict.fromkeys(
        (sympy.legendre, sympy.gegenbauer, sympy.jacobi, sympy.chebyshevt, sympy.chebyshevu),
        lambda e, u: [] if e.args[0].is_integer else _positive(u + 1),
    ),
    # P_n^m(u) = (1 - u^2)^(m/2) times a polynomial for integers n and m
    sympy.assoc_legendre: lambda e, u: [] if e.args[0].is_integer and e.args[1].is_even else _positive(1 - u**2),
    sympy.hyper: _of_hypergeometric,
}
