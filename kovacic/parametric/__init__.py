"""The values of the parameters for which y'' = S y has Liouvillian solutions.

S over Q(t1, ..., tk) becomes a `ParametricAnswer`: the partition of parameter space into regions, each an exact statement with
Kovacic's case, and whether the list is proven to be complete.  Read `api` first, then `partition`.  One step a module:

1. `api` reads S, and makes an algebraic constant one more parameter; `assumptions` about the parameters are read from words,
   and from those of SymPy's symbols;
2. `partition` gets the generic answer from the engine, and treats the values at which S changes by recursion on hypersurfaces,
   which `restriction` finds, with S there;
3. `theorems` describe all other values where there are few singular points, maybe in z = s^n: Kimura's (`riemann`, at most
   three regular ones) and that of Martinet & Ramis (one irregular one);
4. `search` treats everything else, by the `exponents` and the ranks of matrices that depend on the parameters;
5. both give exact `statements` about the parameters, true or false at every algebraic point: a function vanishes, an equation
   has a root among `integers`, Delta_d vanishes for a `natural` number d;
6. `regions`: statement, case and group, without those that earlier ones cover, and the cases of a theorem;
7. `claims`: functions of the parameters, and the printed form of a statement, true or false at a point as a reader understands
   it; `integers` makes claims, with every stratum of a condition that was solved for a parameter; `prose` alone writes them,
   and `formulas` the functions in them; `solutions` are formulas for a region, also in the integer of its condition;
8. `parametric_answer`: the answer; statements as data by `record`; `api` compares with the engine at exact points.
"""
