"""The question as it was asked, and its answer in the user's terms.

Text and SymPy objects are read here, once: a potential, "V(x) = ...", or Schroedinger's equation as a physicist writes it,
-hbar^2/(2 m) psi'' + V psi = E psi.  With the kinetic factor k = hbar^2/(2 m) > 0 it is psi'' = S psi, S = (V - E)/k.

Letters stand for sqrt(a), and for square roots of several numbers, while the spectrum is looked for.  One square root, or
another root of one number, is computed with as such.  Several of them would have a common generator, that isn't written in the
user's roots; sines and cosines bring in I, and next to parameters a root isn't recognised as the root of its square; so each
is a positive parameter there, and its value is put in at the end.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import chain, count
from typing import Any

import sympy
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from kovacic.bound_states.levels import Spectrum
from kovacic.bound_states.question import FRIEDRICHS, Asked, SpectralProblem, read_boundary
from kovacic.bound_states.signs import Signs
from kovacic.closed_form.steps import JUMPING
from kovacic.equation import DEFAULT_VARIABLE, EULER, PI, parameters_of
from kovacic.errors import InputError, LimitExceeded, NotRational
from kovacic.general_solution.boundary_problems import read_domain
from kovacic.limits import Limits
from kovacic.numbers.exact import exact_text
from kovacic.numbers.numerals import as_text
from kovacic.parametric.assumptions import Assumptions, read_assumptions
from kovacic.parametric.restriction import Letters, own_parameters
from kovacic.reading.lexer import scanned
from kovacic.reading.linear import SYMBOLIC_LIMITS
from kovacic.reading.names import NUMBER_NAMES, is_letter
from kovacic.reading.naming import USUAL_VARIABLES, chosen_variable
from kovacic.reading.read import read_input
from kovacic.reading.source import parts_of, source_of
from kovacic.reading.substitution import value_text, values_among
from kovacic.reading.symbolic import expression_of, names_of, read_expression
from kovacic.sturm_liouville.problem import stretches_of
from kovacic.writing.formula import caret

#: V(x) = ..., V = ...
_LEFT_SIDE = re.compile(r"\s*[VU]\s*(?:\(\s*(\w+)\s*\))?\s*=(?!=)")


#: V, the variable, what was guessed when a text was read, and the kinetic factor k of -k psi'' + V psi = E psi.
_Read = tuple[Any, str, tuple[str, ...], Any]


def asked(
    V: Any,
    *,
    domain: Sequence[Any],
    energy: str,
    var: Any,
    assume: Mapping[Any, Any] | None,
    boundary: str | None,
    names: Sequence[str],
    limits: Limits,
) -> Asked:
    """The question of a call of `kovacic.spectrum`, where the parameters are described.

    Raises `InputError` for what isn't a potential, a domain or a boundary condition, and `LimitExceeded`.
    """
    if not isinstance(energy, str) or not energy.isidentifier():
        raise InputError(f"{energy!r} can't be the name of the energy")
    ends = read_domain(domain)
    potential, x, guesses, kinetic = _read(V, None if var is None else str(var), energy, names, limits)
    if x == energy:
        raise InputError(f"{x} is the variable, and can't be the name of the energy as well")
    values, rest = values_among(assume or {})
    at = {sympy.Symbol(name): read_expression(value_text(v, name, x, limits=limits)) for name, v in values.items()}
    known_names = {*names_of(sympy.Tuple(potential, kinetic, *ends))} - {x}
    unknown = sorted({*values} - known_names)
    if unknown:
        known = ", ".join(sorted(known_names)) or "none"
        raise InputError(f"{unknown[0]} isn't a parameter of V", hint=f"the parameters are {known}")
    potential, kinetic, first, last = (part.xreplace(at) for part in (potential, kinetic, *ends))
    if {sympy.Symbol(x), sympy.Symbol(energy)} & (first.free_symbols | last.free_symbols):
        raise InputError(f"an end of the domain contains {x} or {energy}")
    S = potential - sympy.Symbol(energy)
    S = S if kinetic == 1 else sympy.expand_mul(S / kinetic)
    letters = sorted({*names_of(kinetic)} - {*map(str, rest)})
    notices = [f"{' and '.join(letters)} taken as positive"] * bool(letters)
    return Asked(
        given=V,
        V=potential,
        S=S,
        variable=x,
        interval=(first, last),
        energy=energy,
        boundary=read_boundary(boundary, (first, last), x),
        friedrichs=boundary == FRIEDRICHS,
        assumed={**dict.fromkeys(letters, "positive"), **rest},
        kinetic=kinetic,
        names=names,
        notices=(*guesses, *notices),
    )


def _with_named_roots(question: Asked) -> Asked:
    """With letters for roots of numbers, each between two decimals, if there are several or nested ones, or other letters."""
    S = question.S
    roots = [p for p in S.atoms(sympy.Pow) if p.is_positive and p.is_algebraic and not p.exp.is_Integer]
    if len(roots) < 2 and not (question.letters or S.has(TrigonometricFunction)):
        return question
    taken = names_of(S)
    names = filter(lambda name: name not in taken, map("root_{}".format, count(1)))
    meanings: dict[str, Any] = {}
    known = {}
    for root in sorted(roots, key=lambda root: (-root.count_ops(), sympy.default_sort_key(root))):
        if not S.has(root):  # it occurred inside of another one
            continue
        name = next(names)
        below = sympy.floor(root * 10**6)
        known[name] = f">{sympy.Rational(below, 10**6)} <{sympy.Rational(below + 1, 10**6)}"
        S, meanings[name] = S.xreplace({root: sympy.Symbol(name)}), root
    return replace(question, S=S, roots=meanings, assumed={**question.assumed, **known})


def exact_problem(question: Asked, limits: Limits) -> SpectralProblem:
    """The problem for exact methods.  Raises `NotRational` for a V that isn't rational in one function."""
    question = _with_named_roots(question)
    S = question.S
    if S.has(*JUMPING):  # absolute values and steps may be one function on the domain
        x = sympy.Symbol(question.variable)
        pieces = () if question.letters else stretches_of(S, sympy.S.One, x, question.interval)
        if len(pieces) != 1:
            shown = caret(as_text(question.V))
            raise NotRational(f"{shown} is a function in pieces, and its levels have no formula here")
        S = pieces[0].Q
    parsed = read_input(S, var=question.variable, limits=limits, exponentials=True, names=question.names)
    # A shift, as b in 1/cosh(x - b)^2, doesn't occur in the equation in t.
    meanings = names_of(sympy.Tuple(*dict(parsed.letters).values()))
    in_S = parameters_of(parsed.S.field)
    names = (*in_S, *sorted(question.letters - {*meanings, *in_S}))
    own = own_parameters([name for name in names if name != question.energy], parsed.letters)
    known = read_assumptions(question.assumed or None, question.given, own)
    known = _with_letters(known, parsed.letters, own)
    # pi and e are parameters for the program, and aren't for users.
    free = {*names} - {*names_of(S)}
    constants = {name: value for name, value in ((PI, sympy.pi), (EULER, sympy.E)) if name in free}
    for constant in constants:
        known = known.also(constant, ("irrational", "positive"))
    known, notices = _with_positive_letters(question, known, names)
    question = replace(question, notices=(*question.notices, *notices))
    signs = Signs(known, names)
    first, last = map(signs.real, question.interval)
    if signs.is_nonnegative(first - last) or sympy.oo in (first, -last):
        raise InputError(f"the domain is empty: {first} isn't below {last}")
    if signs.sign(signs.real(question.kinetic)) == -1:
        raise InputError(f"{question.kinetic}, the factor of -psi'', isn't positive")
    letters = {**dict(parsed.letters), **question.roots, **constants}
    return SpectralProblem(
        **vars(question), parsed=parsed, domain=(first, last), known=known, signs=signs, meanings=letters
    )


def _with_positive_letters(question: Asked, known: Assumptions, names: Sequence[str]) -> tuple[Assumptions, list[str]]:
    """The assumptions, with letters of unknown sign that may be taken as positive, and notes on those.

    A domain that isn't empty says a > 0, as 0 < x < pi/a does; a rate of which V and the domain are even has either sign.
    """
    even, notices = _even_rates(question), []
    signs = Signs(known, names)
    for name in sorted(name for name, symbol in signs.symbols.items() if signs.sign(symbol) is None):
        opposite = known.also(name, ("negative",))
        is_implied = False
        if not opposite.of(name).is_contradiction():
            signs_there = Signs(opposite, names)
            first, last = map(signs_there.real, question.interval)
            is_implied = signs_there.sign(last - first) == -1
        if is_implied or name in even:
            known = known.also(name, ("positive",))
        if name in even and not is_implied:
            notices.append(f"{name} is taken as positive, as V doesn't depend on its sign")
    return known, notices


def _even_rates(question: Asked) -> set[str]:
    """The parameters in rates, as a in 1/cosh(a x), of which V and the domain are even functions."""
    x = sympy.Symbol(question.variable)
    arguments = [sympy.expand(f.args[0]) for f in question.S.atoms(sympy.Function) if f.has(x)]
    found = set[str]()
    for rate in {*chain.from_iterable(argument.coeff(x).free_symbols for argument in arguments)} - {x}:
        S, *interval = (given.xreplace({rate: -rate}) for given in (question.S, *question.interval))
        if interval == [*question.interval] and sympy.cancel(S - question.S) == 0:
            found.add(rate.name)
    return found


def unsolved(question: Asked, reason: NotRational) -> Spectrum:
    """The problem alone, for a potential that no formulas are known for."""
    parameters = tuple(sorted(question.letters))
    known = read_assumptions(question.assumed or None, question.given, parameters)
    ends = zip(question.interval, question.boundary.wishes, strict=True)
    is_open = any(end.is_finite and wish is None for end, wish in ends)
    question = replace(question, friedrichs=question.friedrichs or is_open)
    return question.spectrum(parameters=parameters, assumptions=known, reason=f"undecided: {reason.args[0]}")


def _read(V: Any, var: str | None, energy: str, names: Sequence[str], limits: Limits) -> _Read:
    """Reads a text or an expression.  Raises `InputError` unless it is a real potential or a Schroedinger equation."""
    guesses: tuple[str, ...] = ()
    if isinstance(V, str):
        left = _LEFT_SIDE.match(V)
        if left is not None:
            V = V[left.end() :]
            var = var or left[1]
        if "=" in V:
            return _schroedinger(V, var, energy, limits)
        named = var
        if var is None:
            # Errors come below, with their position; names only, since l(l + 1) is a product or a function.
            with suppress(InputError):
                named, _ = _variable_of([name for name in _letters(V) if name not in NUMBER_NAMES])
        source = source_of(V, named, SYMBOLIC_LIMITS, names=(*names, energy))
        if source.unknown:
            raise InputError(
                "a potential is expected, and this is an equation", hint="give V of -y'' + V y = E y alone"
            )
        expression, guesses = expression_of(source, what="the potential"), source.guesses
    else:
        given = V if hasattr(V, "free_symbols") else read_expression(exact_text(V, "the potential"))
        expression = given.xreplace({symbol: sympy.Symbol(symbol.name) for symbol in given.free_symbols})
    _check_real(expression, energy)
    x, notices = _variable_of(names_of(expression)) if var is None else (var, ())
    notices = (*guesses, *notices, *_of_charges(V, expression))
    if "hbar" in names_of(expression):  # hbar^2/(2 m) may have been meant as the factor of -y''
        notices += ("-y'' + V y = E y is solved; give the whole equation for -hbar^2/(2*m)*psi''",)
    return expression, x, notices, sympy.S.One


def _letters(text: str) -> list[str]:
    """The names in a text, each once.  Raises `InputError` for signs that mean nothing."""
    return [*dict.fromkeys(token.text for token in scanned(text) if is_letter(token.text))]


def _of_charges(text: Any, V: Any) -> tuple[str, ...]:
    """A note where e, Euler's number, may have been meant as a charge."""
    is_power = any(power.is_number for power in V.atoms(sympy.exp))
    if isinstance(text, str) and is_power and "e" in _letters(text):
        return ("e is Euler's number; give a charge another name, q^2 for e^2",)
    return ()


def _check_real(V: Any, energy: str) -> None:
    """Raises `InputError` for a V with I, floor or the energy in it, and `LimitExceeded` for long numbers."""
    if energy in names_of(V):
        raise InputError(
            f"the potential contains {energy}, the energy",
            hint="energy= gives it another name",
            shell="--energy gives it another name",
        )
    longest = max((max(abs(int(c.p)), int(c.q)) for c in V.atoms(sympy.Rational)), default=0)
    if longest.bit_length() > SYMBOLIC_LIMITS.bits:
        raise LimitExceeded(f"the potential has numbers of more than {SYMBOLIC_LIMITS.bits} bits", limit="bits")
    if V.has(sympy.I):
        raise InputError("the potential isn't real")
    for unknown in V.atoms(sympy.floor):
        raise InputError(f"the potential can't contain {unknown}", hint="a well is c*Heaviside(a - abs(x))")


def _variable_of(names: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """The variable: x, or the only name if that usually is one, with a note.  Raises `InputError` for several names."""
    if DEFAULT_VARIABLE in names or not names:
        return DEFAULT_VARIABLE, ()
    # The only name that usually is a variable, as r in l (l+1)/r^2 - Z/r.
    usual = [name for name in names if name in USUAL_VARIABLES and name.islower()]
    only = usual[0] if len(usual) == 1 else chosen_variable(names)
    if only in USUAL_VARIABLES:
        return only, (f"{only} is taken for the variable, of which V is a function",)
    return DEFAULT_VARIABLE, (f"{DEFAULT_VARIABLE} is the variable, {only} a parameter",)


def _schroedinger(text: str, var: str | None, energy: str, limits: Limits) -> _Read:
    """The equation in a text.  Raises `InputError` for one that isn't Schroedinger's."""
    source = source_of(text, var, limits, equation=True)
    whole = expression_of(source)
    parts, _ = parts_of(source_of(whole, source.variable, limits, equation=True))
    a, b, c, rest = map(sympy.sympify, parts)
    if rest != 0 or sympy.simplify(b) != 0:
        raise InputError("an equation -k*psi'' + V*psi = E*psi is expected, without a first derivative")
    E = sympy.Symbol(energy)
    slope = sympy.cancel(c.diff(E))
    if slope == 0 or slope.has(E):
        raise InputError(f"the equation has no energy {energy}", hint="energy= gives it another name")
    kinetic = sympy.cancel(a / slope)
    if kinetic.has(sympy.Symbol(source.variable)) or kinetic.is_negative:
        raise InputError(f"the factor of psi'' over that of {energy}, {kinetic}, isn't a positive constant")
    V = sympy.expand_mul(E - sympy.expand_mul(c) / slope)
    _check_real(V, energy)
    return V, source.variable, (*source.guesses, *_of_charges(text, V)), kinetic


def _with_letters(known: Assumptions, letters: Letters, parameters: Iterable[str]) -> Assumptions:
    """With the signs of letters for exp(b), log(2), sqrt(a), and that a isn't negative, since sqrt(a) is real.

    Raises `InputError` for an assumption that makes such an a negative.
    """
    for _, meaning in letters:
        base, exponent = meaning.as_base_exp()
        is_root = base.is_Symbol and exponent.is_Rational and exponent.q % 2 == 0
        if is_root and not {"positive", "nonnegative"} & {*known.of(base.name).sympy_properties()}:
            known = known.also(base.name, ("nonnegative",))
            if known.of(base.name).is_contradiction():
                raise InputError(f"the potential isn't real: {caret(as_text(meaning))} with a negative {base}")
    signs = Signs(known, parameters)
    for letter, meaning in letters:
        value = signs.real(meaning)
        weaker = "nonnegative" if signs.is_nonnegative(value) else "real"
        known = known.also(letter, ({1: "positive", -1: "negative"}.get(signs.sign(value) or 0, weaker),))
    return known
