"""A second opinion on answers of kovacic: reads them as JSON lines and proves them anew, sharing no code with the program.

    python checker.py answers.jsonl          (or kovacic check answers.jsonl; "-" reads standard input)

For each line: "checked", "refuted: why", "not checked: why" (after a minute, too) or "unreadable: why".  Exit status: 0 all
checked, 1 one refuted, 2 one unreadable, 3 one not checked.  It needs Python 3.11 and python-flint alone.

What is proven, for y'' = S y over Q(x) with the S of the line (`input`, `equation`, `gauge`, `solutions` and D aren't looked
at; answers with parameters or with algebraic numbers in S aren't checked):
- "yes": the product of W - omega over the conjugates of omega = y'/y belongs to a form in the solutions, over Q(c)(x), c a
  root of an irreducible polynomial; and no smaller degree is possible, by the exclusions below.
- "no": the group is neither reducible nor imprimitive nor finite and primitive, each excluded by a local condition at places
  of S, or by the absence of a rational form in the solutions (a rank modulo a prime can only be smaller than over Q) and, if
  reducible, of a single rational omega (its expansion, modulo a prime, isn't that of a rational function with few poles).
- the rational form that comes with an answer, and the group, where it is given.

J. Kovacic, J. Symb. Comp. 2 (1986); F. Ulmer & J.-A. Weil, ibid. 22 (1996); M. van Hoeij, ibid. 24 (1997).
"""

from __future__ import annotations

import fileinput
import json
import multiprocessing
import re
import sys
from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from itertools import chain, islice
from math import inf, isqrt, lcm, prod
from typing import Any

from flint import Ordering, acb_poly, acb_series, arb, ctx, fmpq, fmpq_mat, fmpq_mpoly_ctx, fmpq_poly, fmpz, nmod_mat
from flint import nmod_poly as nmod

#: Kovacic's case, the degree of omega, and the degree of a rational form.
STRUCTURES = {"reducible": (1, 1, 2), "imprimitive": (2, 2, 4), "tetrahedral": (3, 4, 6), "octahedral": (3, 6, 8),
              "icosahedral": (3, 12, 12)}  # fmt: skip
ORDERS = {"tetrahedral": {1, 2, 3}, "octahedral": {1, 2, 3, 4}, "icosahedral": {1, 2, 3, 5}}
SIZES = {"cyclic": 1, "dicyclic": 4, "tetrahedral": 24, "octahedral": 48, "icosahedral": 120}
NAMES = {"cyclic": "mu_{n}", "cyclic1": "trivial", "additive": "G_a extended by mu_{n}", "additive1": "G_a", "borel": "Borel",
         "multiplicative": "G_m", "dicyclic": "dicyclic of order {order}", "infinite dihedral": "N(T)", "SL2": "SL2",
         "tetrahedral": "SL(2,3)", "octahedral": "binary octahedral", "icosahedral": "SL(2,5)"}  # fmt: skip
LONGEST = 6000  # the largest degrees, and the most terms of a series, that are computed with
PRIMES = [q for q in range(2**60 + 33, 2**60 + 20_000, 2) if fmpz(q).is_prime()]


def demand(holds: Any, claim: str, *expected: Any) -> None:
    """Refute the answer unless this holds, or is what is expected, and of the same type (true isn't 1)."""
    if repr(holds) != repr(*expected) if expected else not holds:
        raise AssertionError(" ".join([claim, *map(repr, expected)]))


def affordable(size: Any, what: str) -> int:
    """The size; gives up where it would make a computation too long, or isn't known."""
    if size is None or size > LONGEST:
        raise NotImplementedError(f"{what} is too large")
    return int(size)


PLANE, X = fmpq_mpoly_ctx.get(("c", "x"), Ordering.lex), fmpq_poly([0, 1])
C, X2 = PLANE.gens()


class Value:
    """num/den in Q(c, x), in lowest terms."""

    def __init__(self, num: Any, den: Any = 1) -> None:
        num, den = PLANE.constant(1) * num, PLANE.constant(1) * den
        demand(den != 0, "there is no division by zero")
        common = den if den.is_constant() else num.gcd(den)
        self.num, self.den = num // common, den // common

    def __pow__(self, n: int) -> Value:
        leading = str(self.num.leading_coefficient()) + str(self.den.leading_coefficient())
        affordable(n * max(len(leading) * (leading != "11"), *self.num.degrees(), *self.den.degrees()), "a power")
        return Value(self.num**n, self.den**n)

    def over_q(self) -> tuple[Any, Any]:
        """Numerator and monic denominator, of a value without c."""
        demand(self.num.degrees()[0] <= 0 and self.den.degrees()[0] <= 0, "the constants are rational")
        num, den = in_one_variable(self.num, 1), in_one_variable(self.den, 1)
        return num / den.leading_coefficient(), den / den.leading_coefficient()


def in_one_variable(f: Any, i: int) -> Any:
    """The polynomial in the i-th variable, without the other."""
    terms = {powers[i]: coefficient for powers, coefficient in f.to_dict().items()}
    return fmpq_poly([terms.get(n, fmpq(0)) for n in range(max(terms, default=0) + 1)])


OPERATIONS: dict[str, Any] = {"+": (1, lambda a, b: Value(a.num * b.den + b.num * a.den, a.den * b.den)), "**": (3, pow),
                              "-": (1, lambda a, b: Value(a.num * b.den - b.num * a.den, a.den * b.den)),
                              "*": (2, lambda a, b: Value(a.num * b.num, a.den * b.den)),
                              "/": (2, lambda a, b: Value(a.num * b.den, a.den * b.num))}  # fmt: skip


def read(text: str, names: dict[str, Value]) -> Value:
    """The value of an expression with + - * / ** and parentheses, as the program prints them."""
    tokens = [*re.findall(r"[0-9]+|\w+|\*\*|\S", text), ""][::-1]

    def expression(least: int) -> Value:
        token = tokens.pop()
        if token == "-":
            value: Value = OPERATIONS["-"][1](Value(0), expression(2))
        elif token == "(":
            value = expression(0)
            demand(tokens.pop() == ")", "each ( has its )")
        else:
            value = Value(fmpq(fmpz(token))) if token.isdecimal() else names[token]
        while tokens[-1] in OPERATIONS and OPERATIONS[tokens[-1]][0] >= least:
            strength, apply = OPERATIONS[operator := tokens.pop()]
            value = apply(value, int(tokens.pop()) if operator == "**" else expression(strength + 1))
            demand(operator != "**" or tokens[-1] != "**", "a power isn't an exponent")
        return value

    value = expression(0)
    demand(tokens == [""], f"{text[:60]!r} can be read")
    return value


def reduced(f: Any, q: int, point: int = 0) -> Any:
    """f(t + point) modulo q, which must keep the degree."""
    demand(int(f.denom()) % q and (f == 0 or int(f.numer()[f.degree()]) % q), f"{q} is a good prime")
    image = nmod([int(c) % q for c in f.numer().coeffs()], q) * pow(int(f.denom()), -1, q)
    return image.compose(nmod([point % q, 1], q)) if point else image


def frobenius(E: Any, M: Any, e: int, count: int, q: int) -> tuple[Any, bool]:
    """The series a with t^e a a solution of t^2 E y'' = M y modulo q; False where it would need a logarithm."""
    top, bottom, a = [int(c) for c in E.coeffs()], [int(c) for c in M.coeffs()] or [0], [1]
    for n in range(1, count):
        total = sum(bottom[j] * a[n - j] for j in range(1, min(n + 1, len(bottom))))
        total -= sum(top[j] * (n - j + e) * (n - j + e - 1) * a[n - j] for j in range(1, min(n + 1, len(top))))
        pivot = (top[0] * (n + e) * (n + e - 1) - bottom[0]) % q
        if not pivot and total % q:
            return nmod(a, q), False
        a.append(total * pow(pivot, -1, q) % q if pivot else 0)
    return nmod(a, q), True


class Place:
    """The roots of an irreducible p, of multiplicity k in den, where S = num/den; infinity as z = 0 for S(1/z)/z^4."""

    def __init__(self, p: Any, k: int, num: Any, den: Any, infinite: bool = False) -> None:
        self.p, self.k, self.num, self.den, self.infinite = p, k, num, den, infinite
        self.size, self.nu = int(p.degree()), max(k // 2, 1)  # nu: of a pole of omega, for k even or 1
        rest = den // p**k
        b = num * (rest * p.derivative() ** 2 % p).xgcd(p)[1] if k == 2 else fmpq_poly(0)
        self.leading = (num * rest if k > 2 else 1 + 4 * b) % p  # in Q[x]/p: Delta^2, or S up to a square
        square = self.leading[0] if k <= 2 and self.leading.degree() <= 0 else fmpq(-1)
        root = fmpq(isqrt(int(max(square.p * square.q, 0))), square.q)
        self.difference: Any = root if root * root == square else None  # Delta, if it is a rational number

    def roots(self, moduli: Iterable[int] = PRIMES) -> Iterator[tuple[int, int]]:
        """The primes modulo which p has a simple root, and the least one."""
        least = ((q, min((int(r) for r, k in reduced(self.p, q).roots() if k == 1), default=-1)) for q in moduli)
        return ((q, root) for q, root in least if root >= 0)

    def local(self, root: int, q: int) -> tuple[Any, Any]:
        """E and M with S = M/(t^max(k, 2) E) at a root of p modulo q."""
        num, den = reduced(self.num, q, root), reduced(self.den, q, root)
        demand(not any(int(den[i]) for i in range(self.k)) and int(den[self.k]), f"{q} keeps the order of a pole")
        return den.right_shift(self.k), num.left_shift(max(2 - self.k, 0))

    @cached_property
    def logarithm(self) -> bool:
        """Is there a logarithm, provably?"""
        if self.k != 2 or self.difference is None or self.difference == 0 or self.difference.q > 1:
            return self.k == 1 or self.difference == 0
        n = affordable(self.difference, "an exponent difference")
        q, root = next(self.roots())
        return not frobenius(*self.local(root, q), (1 - n) * pow(2, -1, q) % q, n + 1, q)[1]

    def is_not_a_square(self) -> bool:
        """Is `leading` no square in Q[x]/p?  Proven by a prime modulo which it isn't one at a root of p."""
        return any(fmpz(int(reduced(self.leading, q)(r))).jacobi(q) == -1 for q, r in islice(self.roots(), 40))

    def least_valuation(self, m: int) -> Any:
        """The least integer that can be the valuation of a rational form of degree m; infinite if there is none."""
        signs, d = [m] if self.logarithm else range(-m, m + 1, 2), self.difference or fmpq(0)
        possible = [fmpq(m * self.k, 4)] if self.k > 2 else [(m + i * d) / 2 for i in signs]
        return min((int(value.p) for value in possible if value.q == 1), default=inf)

    def exponents(self) -> Any:
        """A ball around the sum over the roots of p of the real parts of the least exponents (k not odd > 2)."""
        total, nu, cap, ctx.cap = arb(0), self.nu, ctx.cap, self.nu + 1  # where FLINT's series end
        parts = self.num * self.p ** (2 * nu - self.k), self.den // self.p**self.k, self.p
        for root, _ in self.p.complex_roots():
            shifted = (acb_poly([arb(c) for c in f.coeffs()])(acb_poly([root, 1])).coeffs() for f in parts)
            num, rest, unit = (acb_series(f, nu + 1) for f in shifted)
            ratio = num / (rest * acb_series([unit[i + 1] for i in range(nu)], nu) ** self.k)  # t^(2 nu) S
            half = ratio[0].sqrt() * (ratio / ratio[0]).sqrt()[nu - 1] if nu > 1 else (1 + 4 * ratio[0]).sqrt() / 2
            total += arb(nu) / 2 + (abs(half.real) if self.logarithm else -abs(half.real))
        ctx.cap = cap
        return total

    def expansions(self, root: int, q: int, count: int) -> Iterator[Any]:
        """The series t^nu omega modulo q of the solutions that have one, where the place tells the solutions apart."""
        nu, d, (E, M) = self.nu, self.difference, self.local(root, q)
        s = [int(c) for c in M.mul_low(E.inverse_series_trunc(count), count).coeffs()] + [0] * count
        lead = (s[0] if nu > 1 else 1 + 4 * s[0]) % q
        if fmpz(lead).jacobi(q) == -1:
            return
        first = int(fmpz(lead).sqrtmod(q)) if d is None else int(d.p) * pow(int(d.q), -1, q)
        for sign in (1,) if self.logarithm else (1, -1):
            w = [(sign * first if nu > 1 else (1 + sign * first) * pow(2, -1, q)) % q]
            for j in range(1, count):  # t^(2 nu) (omega' + omega^2) = s
                rest = s[j] - sum(a * b for a, b in zip(w[1:j], w[j - 1 : 0 : -1], strict=True))
                rest -= (j - 2 * nu + 1) * w[j - nu + 1] if nu > 1 and j >= nu - 1 else 0
                pivot = (2 * w[0] + (j - 1 if nu == 1 else 0)) % q
                demand(pivot, "the prime avoids the exponents")
                w.append(rest * pow(pivot, -1, q) % q)
            yield nmod(w, q)


def residues(phi: Value) -> list[tuple[Any, int]]:
    """The factors of the denominator of phi, and the residues there, for a phi = F'/F with F rational."""
    num, den = phi.over_q()
    simple = num.degree() < den.degree() and den.gcd(den.derivative()).degree() == 0
    found = [(p / p[p.degree()], num * den.derivative().xgcd(p)[1] % p) for p, _ in den.factor()[1]] if simple else []
    demand(simple and all(v.degree() <= 0 and v[0].q == 1 for _, v in found), "a form is a rational function")
    return [(p, int(v[0].p)) for p, v in found]


def inverse_has_an_integral(factors: list[tuple[Any, int]]) -> Any:
    """Is 1/prod p^v = num/den = (A/E)', E = gcd(den, den')?  A linear system for A, which is unique up to multiples of E."""
    affordable(sum(abs(v) * p.degree() for p, v in factors), "the degree of a form")
    num, den = (prod((p ** max(s * v, 0) for p, v in factors), start=X**0) for s in (-1, 1))
    E = den.gcd(den.derivative())
    size = affordable(max(num.degree() - den.degree() + E.degree() + 2, E.degree() + 1), "the degree of a form")
    columns = [(X**i).derivative() * den - X**i * (E.derivative() * den // E) for i in range(size)] + [num * E]
    height = max(column.degree() for column in columns) + 1
    return fmpq_mat(height, size + 1, [c[k] for k in range(height) for c in columns]).rank() == size - 1


def order_modulo(q: int, n: int, num: Any, den: Any, poles: list[tuple[Any, Any]]) -> int:
    """n, if it is the order modulo q of the class of D = sum l d (P - P'), for sqrt(num/den) dx = d f'/f dx + ... at the P over
    the roots of f, for all poles (f, d).  With y^2 = h, kD is the divisor of a function if a + b y vanishes to the order
    2 k l d at the P, 2N times in all, for polynomials with deg a, deg b + deg h/2 <= N, b != 0."""
    demand(type(q) is type(n) is int and n > 0 and q > 2 and fmpz(q).is_prime(), "an order is one modulo an odd prime")
    if poles[-1][0] is None:  # infinity: x = r + 1/t
        x = X + next(r for r in range(q) if int(reduced(num * den, q)(r)))
        num, den, *others = (fmpq_poly(f(x).coeffs()[::-1]) for f in (num, den, *(f for f, _ in poles[:-1])))
        den, poles = den * X**2, [*zip([*others, X], (d for _, d in poles), strict=True)]
    factors, l = num.factor()[1] + den.factor()[1], lcm(*(d.q for _, d in poles))  # noqa: E741
    t, R = prod(p ** (k // 2) for p, k in factors), prod(f for f, _ in poles)  # y = sqrt(num/den) den/t
    E, whole = prod(f ** int(l * d) for f, d in poles), prod(p for p, _ in factors)
    h, rest, top, under, R, E = (reduced(f, q) for f in (num * den // t**2, whole, den // R**2, t // R, R, E))
    demand(rest.gcd(rest.derivative()).degree() == 0, f"{q} is a good prime: no points meet")
    slopes = (reduced(f, q).derivative() * (R // reduced(f, q)) * int(d.p) * pow(int(d.q), -1, q) for f, d in poles)
    y = sum(slopes, R * 0) * top * under.xgcd(R)[1] % R
    demand((y * y - h) % R == 0, "the residues are exponent differences")

    def principal(k: int) -> bool:
        U, v, N = E ** (2 * k), y, affordable(k * E.degree(), "an order")
        for _ in range(N.bit_length() + 1):  # Newton's steps for sqrt(h)
            v = (v * v + h) * (2 * v).xgcd(U)[1] % U
        multiples = [v.left_shift(i) % U for i in range(N + 1 - (h.degree() + 1) // 2)]
        rows = [[int(f[j]) for j in range(N + 1, 2 * N)] for f in multiples]
        return bool(rows) and int(nmod_mat(rows, q).rank()) < len(rows)

    least = principal(n) and not any(principal(n // int(p)) for p, _ in fmpz(n).factor())
    demand(least, f"{n} is the order modulo {q}")
    return n


class Answer:
    """One line: the JSON object, the names in its expressions, and S = num/den."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data, self.proof, self.names = data, data["proof"], {data["variable"]: Value(X2)}
        demand(data["variable"].isidentifier(), "the variable has a name")
        self.S = read(data["S"], self.names)
        self.num, self.den = self.S.over_q()
        affordable(max(self.num.degree(), self.den.degree()), "the degree of S")
        if data["constants"] is not None:
            demand(self.names.setdefault(data["constants"]["symbol"], c := Value(C)) is c, "the names are different")

    @cached_property
    def places(self) -> list[Place]:
        """The finite ones and, last, infinity."""
        k = self.num.degree() - self.den.degree() + 4 if self.num != 0 else 0
        flipped = [fmpq_poly(f.coeffs()[::-1]) * X ** max(e, 0) for f, e in ((self.num, -k), (self.den, k))]
        found = [Place(p / p[p.degree()], m, self.num, self.den) for p, m in self.den.factor()[1]]
        return [*found, Place(X, max(k, 0), flipped[0], flipped[1], infinite=True)]

    def place(self, name: str) -> Place:
        """The place with this factor, or "infinity"."""
        key = name if name == "infinity" else str(read(name, self.names).over_q()[0])
        return {"infinity" if place.infinite else str(place.p): place for place in self.places}[key]

    def check(self) -> None:
        """Prove everything that is claimed."""
        data, proof, names = self.data, self.proof, list(STRUCTURES)
        structure, excluded = proof["structure"], [entry["structure"] for entry in proof["excluded"]]
        if proof["undecided"] is not None:
            raise NotImplementedError(f"the answer is undecided: {proof['undecided']!r}")
        demand(excluded, "what is excluded is", names if structure is None else names[: names.index(structure)])
        demand(data["case"], "the case is", None if structure is None else STRUCTURES[structure][0])
        demand(data["status"], "the status is", "none" if structure is None else "liouvillian")
        for entry in proof["excluded"]:
            self.excluded(entry["structure"], entry["evidence"])
        form = slope = H = None
        if structure is None:
            beside = [data["riccati"], data["constants"], proof["invariant"], proof["semi_invariant"]]
            demand(beside == [None] * 4, "there is no solution beside a proof that there is none")
        else:
            slope, H = self.solution(STRUCTURES[structure][1])
            if structure != "reducible" or proof["invariant"] is not None:
                form = self.form(proof["invariant"], STRUCTURES[structure][2], C)
            demand(residues(form[0]) is not None if form else self.dimension(2) == 0, "omega is unique")
        if data.get("group") is not None:
            family, n = self.group(structure, form, slope, H)
            order = SIZES[family] * (n or 1) if family in SIZES else None
            name = NAMES.get(f"{family}{n}", NAMES[family]).format(n=n, order=order)
            expected = {"name": name, "order": order, "finite": order is not None, "family": family, "n": n}
            for key in {"name", "order", "finite"} | (set(expected) & set(data["group"])):
                demand(data["group"][key], f"the {key} of the group is", expected[key])

    def excluded(self, structure: str, evidence: Any) -> None:
        """The group doesn't have this structure, by the evidence."""
        reducible, finite, m = structure == "reducible", ORDERS.get(structure), STRUCTURES[structure][2]
        branches = sum(p.size for p in self.places if (p.k % 2 if p.k > 2 else (p.difference or fmpq(1)).q == 2))
        rules: dict[str, Callable[[Place], Any]] = {
            "ramified": lambda p: reducible and p.k > 2 and p.k % 2,
            "not_a_square": lambda p: reducible and p.k > 1 and p.k % 2 == 0 and p.is_not_a_square(),
            "logarithm": lambda p: not reducible and p.logarithm,
            "irregular": lambda p: finite and p.k > 2,
            "too_few_branch_points": lambda p: structure == "imprimitive" and branches < 2,
            "exponents": lambda p: finite and 0 < p.k <= 2 and int((p.difference or fmpq(1, 7)).q) not in finite,
        }
        found = set() if reducible else {"no_rational_omega"}
        for item in evidence:
            kind, rule = item["kind"], item.get("rule")
            if kind == "no_rational_omega":
                self.no_unique_omega(item["prime"], item["place"])
            elif kind == "no_invariant":
                demand(item["invariant_degree"], "the degree of the form is", m)
                demand(self.dimension(m, item["prime"], item["point"]) == 0, f"there is no rational form of degree {m}")
            else:
                demand(any(rules[rule](self.place(p)) for p in item["places"] or ["infinity"]), f"a place is {rule}")
            found.add("no_rational_omega" if rule == "not_a_square" else kind)
        demand("necessary_condition" in found or len(found) == 2, f"the group isn't {structure}")

    def dimension(self, m: int, prime: int | None = None, point: int | None = None) -> int:
        """An upper bound for the dimension of the rational forms of degree m, from expansions modulo a prime."""
        valuations = [place.least_valuation(m) for place in self.places]
        room = m - sum(v * p.size for v, p in zip(valuations, self.places, strict=True))
        if room < 0:
            return 0
        n, q = affordable(room + m + 6, f"the number of zeros of a form of degree {m}"), prime or PRIMES[0]
        demand(q > 2 * n and fmpz(q).is_prime(), "the modulus is a large prime")
        c = point if point is not None else next(c for c in range(LONGEST + 1) if int(reduced(self.den, q)(c)))
        den, num = reduced(self.den, q, c), reduced(self.num, q, c).left_shift(2)
        demand(int(den[0]), "the point is ordinary")
        y1, y2 = frobenius(den, num, 0, n, q)[0], frobenius(den, num, 1, n, q)[0].left_shift(1)
        scale = nmod([1], q)
        for place, v in zip(self.places[:-1], valuations, strict=False):
            power = reduced(place.p, q, c).truncate(n).pow_trunc(abs(v), n)
            scale = scale.mul_low(power.inverse_series_trunc(n) if v > 0 else power, n)
        forms = [scale.mul_low(y1.pow_trunc(m - i, n), n).mul_low(y2.pow_trunc(i, n), n) for i in range(m + 1)]
        return m + 1 - int(nmod_mat([[int(form[j]) for j in range(room + 1, n)] for form in forms], q).rank())

    def no_unique_omega(self, prime: int | None, name: str) -> None:
        """No omega in Q(x) that is the only one: no solution's is A/(den B) modulo a prime, deg B <= the number of zeros."""
        ramified = any(place.k > 2 and place.k % 2 for place in self.places)
        if ramified or (zeros := 1 - sum((place.exponents() for place in self.places if place.k), arb(0))) < 0:
            return
        degree = affordable(zeros.upper().floor().unique_fmpz(), "the number of zeros of a solution")
        apart = [p for p in self.places if p.k and (p.difference is None or p.difference.q > 1 or p.logarithm)]
        place = self.place(name) if name or not apart else apart[0]
        demand(place in apart, "the place tells the solutions apart")
        q, root = next(place.roots([prime] if prime else PRIMES), (0, 0))
        demand(q > 10**6 and fmpz(q).is_prime(), "the place has a root modulo a large prime")
        den = reduced(place.den, q, root)
        top = degree + den.degree() + max(p.k for p in self.places)
        for w in place.expansions(root, q, count := affordable(top + degree + 12, "the number of zeros of a solution")):
            r0, r1 = nmod([1], q).left_shift(count), den.right_shift(place.nu).mul_low(w, count)
            while r1.degree() > top:  # r1 = B den w modulo t^count, deg B = count - deg r0
                r0, r1 = r1, r0 % r1
            demand(count - r0.degree() > degree, "no expansion of omega is that of a rational function")

    def form(self, data: dict[str, Any], m: int, modulus: Any) -> tuple[Value, Any, list[Any]]:
        """F'/F, G and N_k with prod (W - y_i'/y_i) = sum (-1)^k N_k/G^k W^(m-k) for a form F = y_1 ... y_m in the solutions:
        N_0 = 1, (k + 1) N_(k+1) = G N_k' + (N_1 - k G') N_k - (m - k + 1) G^2 S N_(k-1), and N_(m+1) = 0, which is demanded."""
        demand(data["degree"], "the degree of a form is", m)
        P = read(data["P"], self.names)
        demand(P.den.is_constant(), "P is a polynomial")
        slope = OPERATIONS["+"][1](read(data["theta"], self.names), Value(P.num.derivative(1), P.num))
        G = slope.den * (self.S.den // slope.den.gcd(self.S.den))
        T, N = self.S.num * (G * G // self.S.den), [PLANE.constant(1), slope.num * (G // slope.den)]
        for k in range(1, m + 1):
            total = G * N[k].derivative(1) + (N[1] - k * G.derivative(1)) * N[k] - (m - k + 1) * T * N[k - 1]
            N.append(total * fmpq(1, k + 1))
        demand(divmod(N.pop(), modulus)[1] == 0, f"there is this form of degree {m}")
        return slope, G, N

    def solution(self, n: int) -> tuple[Value, ...]:
        """The polynomial of omega is that of a form f of degree n; f'/f, and for n = 2 the discriminant, are returned."""
        constants, riccati = self.data["constants"], self.data["riccati"]
        modulus = read(constants["minimal_polynomial"], self.names).num if constants else C
        powers = [k for _, k in in_one_variable(modulus, 0).factor()[1]]
        demand(modulus.degrees()[1] <= 0 and powers == [1], "c has an irreducible polynomial")
        slope, G, N = self.form(self.proof["semi_invariant"], n, modulus)
        a = [read(text, self.names) for text in reversed(riccati["coefficients"])]
        demand(repr(riccati["degree"]) == repr(len(a) - 1) == repr(n), f"the degree of omega is {n}")
        for k in range(n + 1):
            difference = a[k].num * G**k - (-1) ** k * N[k] * a[k].den
            demand(divmod(difference, modulus)[1] == 0, "the roots of the polynomial solve omega' + omega^2 = S")
        both = slope, Value(N[1] ** 2 - 4 * N[2], G**2) if n == 2 else slope
        return tuple(Value(divmod(v.num, modulus)[1], divmod(v.den, modulus)[1]) for v in both)

    def group(self, structure: str | None, form: Any, slope: Any, H: Any) -> tuple[str, int | None]:
        """The family of the group and its n; if imprimitive, by slope = f'/f, f = y1 y2, and sqrt(H) dx = d log(y1/y2)."""
        differences = [place.difference for place in self.places]
        if structure is None or structure in ORDERS:
            return structure or "SL2", None
        if structure == "reducible":
            # The residues of omega are exponents, (1 + d)/2 or (1 - d)/2, and whole numbers; or it has other poles.
            n = None if None in differences else lcm(*(((1 + d) / 2).q for d in differences))
            if form is None:
                return ("borel", None) if n is None else ("additive", n)
            if form[2][1] * form[2][1] != 4 * form[2][2]:  # F has two different factors
                return ("multiplicative", None) if n is None else ("cyclic", n)
            return "cyclic" if inverse_has_an_integral(residues(form[0])) else "additive", n
        if None in differences:  # a local monodromy has infinite order
            return "infinite dihedral", None
        if slope.den.degrees()[0] + slope.num.degrees()[0] > 0:  # the conjugates of f are more products of solutions
            return "dicyclic", 2
        (num, den), group = H.over_q(), self.data["group"]
        e = den.degree() - num.degree() - 4  # the valuation at infinity
        factors = num.factor()[1] + den.factor()[1]
        poles = [(place.p, place.difference) for place in self.places[:-1] if den % place.p**2 == 0]
        poles += [(p, fmpq(1)) for p, k in factors if den % p**2 == 0 and self.den % p != 0]
        poles += [(None, differences[-1])] * (e == -2)
        n = lcm(*(d.q for _, d in poles))
        if sum(p.degree() for p, k in factors if k % 2) + e % 2 == 2:  # genus 0
            return "dicyclic", n
        if orders := poles and group.get("orders"):
            k = n * min(shown := {order_modulo(entry["prime"], entry["order"], num, den, poles) for entry in orders})
            demand(len(shown) > 1 or self.dimension(2 * k) <= (k + 1) % 2, "the order isn't finite")
        if orders or not poles:  # without poles it is a differential of the first kind
            return "infinite dihedral", None
        if not group.get("form"):
            raise NotImplementedError("the order of a group on a curve of positive genus")
        demand(type(n := group["n"]) is int and n > 0, "the group has an order")
        F = self.form(group["form"], affordable(2 * n, "the degree of a form"), C)[0]
        demand(residues(F) is not None and F.num * slope.den != n * slope.num * F.den, "there is a form beside f^n")
        smaller = (n // int(p) for p, _ in fmpz(n).factor())
        demand(all(self.dimension(2 * j) <= (j + 1) % 2 for j in smaller), "n is the least")
        return "dicyclic", n


def verdict(line: str) -> str:
    """What is to be said of one line."""
    try:
        data = json.loads(line)
        if not isinstance(data, dict) or repr(data.get("schema")) != "1" or data.get("field") is not None:
            return "not checked: no answer in schema 1 for an S with rational coefficients"
        with ctx.workprec(333):
            Answer(data).check()
    except json.JSONDecodeError as error:
        return f"unreadable: {error}"
    except AssertionError as claim:
        return f"refuted: it isn't shown that {claim}"
    except (RuntimeError, StopIteration) as reason:
        return f"not checked: {str(reason) or type(reason).__name__}"
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
        return f"refuted: malformed ({type(error).__name__})"
    return "checked"


def verdicts(lines: Iterator[str], seconds: float = 60) -> Iterator[str]:
    """The verdicts, found by a process that is ended, and replaced, where a line takes longer."""
    with multiprocessing.Pool(1) as pool:
        for line in lines:
            try:
                yield pool.apply_async(verdict, [line]).get(seconds)
            except multiprocessing.TimeoutError:
                pool.terminate()
                yield from chain([f"not checked: it takes more than {seconds:g} s"], verdicts(lines, seconds))


def main(files: list[str]) -> int:
    """Check all lines of the files; the exit status."""
    statuses = {0}
    try:
        with fileinput.input(files, encoding="utf-8") as lines:
            for said in verdicts(filter(str.strip, lines)):
                statuses.add(("checked", "refuted", "unreadable", "not checked").index(said.partition(":")[0]))
                print(f"{lines.filename()}:{lines.filelineno()}: {said}")
    except (OSError, UnicodeError) as error:
        print(f"checker: {error}", file=sys.stderr)
        return 2
    return min(statuses - {0}, default=0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
