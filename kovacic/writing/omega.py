"""omega = y'/y in writing: the function, or the polynomial of which it is a root, and that of its constants."""

from __future__ import annotations

from kovacic.algebra.extension import AlgebraicField
from kovacic.algebra.rationals import RationalPoly
from kovacic.decision import RiccatiPolynomial
from kovacic.numbers.numerals import as_text
from kovacic.writing.formula import Formulas, Math, caret, latex_text


def omega_math(riccati: RiccatiPolynomial, formulas: Formulas) -> Math:
    """omega where it is rational, else the equation of which it is a root, a term a line."""
    if riccati.degree == 1:
        return formulas.math(-riccati.coefficients[0])
    w = formulas.unknown
    m = riccati.degree
    texts = [f"{w}^{m}"]
    latex = [f"{w}^{{{m}}}"]
    for k in range(m - 1, -1, -1):
        coefficient = riccati.coefficients[k]
        if not coefficient:
            continue
        sign = "-" if formulas.math(coefficient).text.removeprefix("(").startswith("-") else "+"
        positive = coefficient if sign == "+" else -coefficient
        if k == 0:
            value = formulas.factor(positive)
        elif k == 1:
            value = formulas.times(positive, w, w)
        else:
            value = formulas.times(positive, f"{w}^{k}", f"{w}^{{{k}}}")
        texts.append(f"{sign} {value.text}")
        latex.append(f"{sign} {value.latex}")
    lines = r" \\ \displaystyle ".join(latex)
    return Math("\n".join(texts) + " = 0", rf"\begin{{array}}{{l}} \displaystyle {lines} = 0 \end{{array}}")


def constants_math(riccati: RiccatiPolynomial, formulas: Formulas) -> Math | None:
    """The polynomial of which omega's constant is a root."""
    field = riccati.P.field
    if not isinstance(field, AlgebraicField) or field == formulas.field:
        return None
    text = field.modulus.to_str(formulas.symbol)
    return Math(caret(text), latex_text(text))


def simple_roots(riccati: RiccatiPolynomial, formulas: Formulas) -> str | None:
    """The values of omega's constant where it is a square root of a rational number: "i or -i", "sqrt(2) or -sqrt(2)"."""
    field = riccati.P.field
    if not isinstance(field, AlgebraicField) or field == formulas.field:
        return None
    if not isinstance(field.modulus, RationalPoly):
        return None
    constant, *middle = field.modulus.coefficients()[:-1]
    if middle != [0]:
        return None
    square = -constant
    size = abs(square)
    root = "" if size == 1 else f"sqrt({as_text(size)})"
    unit = "i" if square < 0 else ""
    written = "*".join(part for part in (unit, root) if part)
    return f"{written} or -{written}"


def omega_lines(riccati: RiccatiPolynomial, formulas: Formulas) -> list[str]:
    """omega, or its polynomial, as text."""
    omega = omega_math(riccati, formulas)
    roots = simple_roots(riccati, formulas)
    if roots is not None and riccati.degree == 1 and omega.text == formulas.symbol:
        return [f"omega = {roots}"]
    if riccati.degree == 1:
        lines = [f"omega = {omega.text}"]
    else:
        lines = [f"omega is a root {formulas.unknown} of", *(f"    {line}" for line in omega.text.splitlines())]
    constants = constants_math(riccati, formulas)
    if roots is not None:
        lines.append(f"where {formulas.symbol} is {roots}")
    elif constants is not None:
        lines.append(f"where {formulas.symbol} is any root of {constants.text}")
    return lines
