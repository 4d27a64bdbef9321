"""Eigenvalues of Sturm-Liouville problems as proven numbers: -(p y')' + q y = E w y on an interval, a half-line or the
line.

The problem is brought to y'' = (Q - E W) y.  The claim that is proven is a count: N(E), the number of eigenvalues below an
exact number E, from the zeros of the solutions that belong to the two ends (Sturm).  A level number k lies between two
numbers with N <= k and N >= k + 1; how these two were guessed needs no proof.  Read `levels` first.  One step a module:

1. `problem`: the normal form, its analytic pieces, the conditions at the ends;
2. `ends`: with which values the solution of an end begins, or between which, by lower bounds on a half-line;
3. `discs`: Taylor series with proven errors, along the axis;
4. `levels`: N(E), for separated and for periodic conditions, and the results;
5. `solve`: brackets, their refinement, and the proof;
6. `families`: the eigenvalues as formulas, where the equation has constant coefficients after a change of variable,
   and equations for them, where it has linear ones in pieces.
"""
