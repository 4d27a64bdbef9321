"""Input: what a user writes, as a rational function S, an equation a y'' + b y' + c y = f, or a SymPy expression.

In goes text, a SymPy object, a pair of coefficient sequences, or a number; out comes `Parsed`, with S over the field of the
constants that occurred, and with what the user should know about how it was read.  Wrong input raises `InputError` with the
position in the text, what would be too large `LimitExceeded` before it is computed; nothing is ever executed.

`read` is the door: read it first, and then `source`, which every text and SymPy expression goes through.  A text is scanned by
`lexer`, taken apart by `pieces` (an equation, its values, what stands around them), and written in one notation by `dialects`,
a table of token rules; `naming` decides what every name is, and `parser` carries out the operations.  A SymPy expression is
walked by `symbolic`.  Both call a reader, which says what numbers, names and calls mean: `expression` (S), `differential`
(equations), `systems` (several equations), or `symbolic` (SymPy's expressions).  Readers calculate with `arithmetic`, or with
`linear` where an unknown function or what isn't rational may occur; `exponentials` makes exp(k x) a variable, and
`change_of_variable` has the way back;
`constants` has the field, `names` the names with a meaning; the results, `Equation` and `Parsed`, are `kovacic.equation`'s.
"""
