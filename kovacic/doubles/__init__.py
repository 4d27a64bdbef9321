"""Solutions as NumPy functions in double precision, with a measured error; `lambdify` is the entry."""
