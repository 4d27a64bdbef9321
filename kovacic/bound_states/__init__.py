"""The discrete spectrum of -y'' + V y = E y, with the wave functions in the user's variable.

In goes V with real parameters and a domain, out comes a `Spectrum`.  Read `api` first.  One step a module:

0. `asked`: the potential, the domain and the assumptions as they were given, and answers in the user's terms; `question` is
   the problem for exact methods, with `signs` of expressions in the parameters;
1. `coordinates`: the change of variable, and poles; `ends`: how many solutions are square integrable at each end; `frame`: the
   coordinates z(x) in which the equation may be a standard one;
2. `families`: the standard equations, each with its levels for all n at once, and why these are all; `energies` solves for E
   and writes the conditions; `without_levels` are periodic and repulsive potentials;
3. `darboux` brings other potentials to the families; `closed_forms`: where no formula is known, the levels with a closed form,
   from the conditions on E, and are these all?
4. `levels`: the result.
"""
