"""2x2 matrices of balls that act on states (y, y'), and products of many affine maps: a right-hand side adds a state.

A product of k factors, one after the other, may lose k bits in ball arithmetic ("wrapping"); balanced products lose O(log k).
"""

from __future__ import annotations

from flint import acb

State = tuple["acb", "acb"]  # (y, y')
Matrix = tuple["acb", "acb", "acb", "acb"]  # (m11, m12, m21, m22)
Affine = tuple[Matrix, State]  # v -> M v + p
NOTHING: State = (acb(0), acb(0))
IDENTITY: Matrix = (acb(1), acb(0), acb(0), acb(1))


def multiply(m: Matrix, n: Matrix) -> Matrix:
    """The product m n."""
    # By rows: (a, b; c, d) (e, f; g, h).
    a, b, c, d = m
    e, f, g, h = n
    return a * e + b * g, a * f + b * h, c * e + d * g, c * f + d * h


def real_part(m: Matrix) -> Matrix:
    """The real parts of the entries."""
    return acb(m[0].real), acb(m[1].real), acb(m[2].real), acb(m[3].real)


def adjugate(m: Matrix) -> Matrix:
    """The inverse of a matrix of determinant 1."""
    a, b, c, d = m
    return d, -b, -c, a


def inverse_matrix(m: Matrix) -> Matrix:
    """The inverse of any regular matrix."""
    determinant = m[0] * m[3] - m[1] * m[2]
    return m[3] / determinant, -m[1] / determinant, -m[2] / determinant, m[0] / determinant


def fundamental(first: State, second: State) -> Matrix:
    """The matrix with the states (y, y') of two solutions as its columns."""
    return first[0], second[0], first[1], second[1]


def apply(m: Matrix, v: State) -> State:
    """m v."""
    return m[0] * v[0] + m[1] * v[1], m[2] * v[0] + m[3] * v[1]


def state_image(affine: Affine, v: State) -> State:
    """M v + p."""
    y, dy = apply(affine[0], v)
    return y + affine[1][0], dy + affine[1][1]


def compose(second: Affine, first: Affine) -> Affine:
    """The second map after the first one."""
    # M2 (M1 v + p1) + p2 = M2 M1 v + (M2 p1 + p2).
    return multiply(second[0], first[0]), state_image(second, first[1])


class MapProduct:
    """A_k ... A_1 for maps A v = M v + p: a binary counter of partial products, O(log k) factors for every prefix."""

    def __init__(self, *parts: tuple[int, Affine]) -> None:
        self._parts = parts  # sizes are falling powers of two, the earliest factors first

    def after(self, matrix: Matrix, added: State = NOTHING) -> MapProduct:
        """With one more map v -> M v + added on the left."""
        last = matrix, added
        parts = self._parts
        size = 1
        # As in counting in binary: two products of equal length become one of twice the length.
        while parts and parts[-1][0] == size:
            last = compose(last, parts[-1][1])
            size = 2 * size
            parts = parts[:-1]
        return MapProduct(*parts, (size, last))

    def apply(self, state: State) -> State:
        """A_k ... A_1 v."""
        # The first parts are the earliest factors, which act first.
        for _, part in self._parts:
            state = state_image(part, state)
        return state

    def whole(self) -> Affine:
        """A_k ... A_1."""
        total = self._parts[0][1] if self._parts else (IDENTITY, NOTHING)
        for _, part in self._parts[1:]:
            total = compose(part, total)
        return total


def matrix_product(matrices: list[Matrix]) -> Matrix:
    """M_k ... M_1 for the list [M_1, ..., M_k]."""
    total = MapProduct()
    for matrix in matrices:
        total = total.after(matrix)
    return total.whole()[0]
