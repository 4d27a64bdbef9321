"""Input: what a user writes, as a rational function S, an equation a y'' + b y' + c y = f, or a SymPy expression.

In goes text, a SymPy object, a pair of coefficient sequences, or a number; out comes `Parsed`, with S over the field of the
constants that occurred, and with what the user should know about how it was read.  Wrong input raises `InputError` with the
position in the text, what would be too large `LimitExceeded` before it is computed; nothing is ever executed.

`read` is the door: read it first.  A text goes through `lexer` and `parser`, which call a reader: `expression` (S), `equation`
or `symbolic` (SymPy's expressions).  SymPy's objects go through `from_sympy` to the same readers.  Their operations are those
of `arithmetic`, and of `linear` where an unknown function occurs; `constants` has the field, `given` the results and the
names that mean something.
"""
