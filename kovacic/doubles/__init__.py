"""Solutions as NumPy functions in double precision, their errors measured and not proven.

In goes a `Solution` with an interval, or any equation with a start; out comes a function of arrays of points.  Read
`lambdify` first: it chooses between a product of powers and exponentials made from the certificate (`product_form`) and a
table of polynomials (`tabulate`), between plain arithmetic and that of `double_double`, and measures the error.
"""
