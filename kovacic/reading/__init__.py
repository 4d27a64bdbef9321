"""Input: what a user writes, as a rational function S, an equation a y'' + b y' + c y = f, or a SymPy expression.

In goes text, a SymPy object, a pair of coefficient sequences, or a number; out comes `Parsed`, with S over the field of the
constants that occurred, and with what the user should know about how it was read.  Wrong input raises `InputError` with the
position in the text, what would be too large `LimitExceeded` before it is computed; nothing is ever executed.

`read` is the door: read it first, and then `source`, which every text and SymPy expression goes through.  A text is scanned by
`lexer`; `notations`, a table of patterns of tokens, has what other systems and books write in a few tokens of their own;
`pieces` takes a paste apart (an equation, its values, surrounding text); `dialects` reads notations with arbitrary contents:
fractions, roots, bars, derivatives.  `naming` decides what every name is, and `parser` carries out the operations.  A SymPy
expression is walked by `symbolic`.  Both call a reader, which says what numbers, names and calls mean: `expression` (S),
`differential` (equations), or `symbolic` (SymPy's expressions, and systems).  Readers calculate with `arithmetic`, or with
`linear` where an unknown function or non-rational terms may occur.  Non-rational coefficients are tried by `functions`:
`exponentials` makes exp(k x) or x^k a variable, which `change_of_variable` knows; `letters` stand for constants.
`constants` has the field, `names` the names with a meaning; the results, `Equation` and `Parsed`, are `kovacic.equation`'s.
"""
