"""y1 and y2 in closed form: a decision with its certificate goes in, two checked SymPy expressions come out.

`form` is the entry, and the module to read first.  `structure.build` gives the same as data, without SymPy: products
(`product`), integrals (`primitive`, `curve`) and Klein's invariant.  `atoms`,
`real_pair` and `integrals` write each kind down; `check` verifies the structure exactly, and what
is shown by `jets`.  After a change of variable `way_back` takes results to the variable that was given.
"""
