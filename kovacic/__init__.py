"""Kovacic's algorithm: closed-form (Liouvillian) solutions of y'' = S(x) y, or a proof that there are none.

Text, a SymPy expression or coefficients go in (`solve`), a frozen and verified `Solution` comes out.  The modules to read
first: `kovacic.api`, then `kovacic.engine.decide`, where the cases are taken in turn.

>>> import kovacic
>>> kovacic.solve("x^2 + 3").case
1
"""

from importlib import import_module

__version__ = "0.4.0"

#: The public names by their modules; each is imported when it is first used, so that `import kovacic` costs nothing.
#: (lazy_loader would do the same, but it and what it imports cost 8 ms at every start, ten times as much as this.)
_PUBLIC_NAMES = {
    "api": ("Verdict", "decide"),
    "batch": ("solve_many",),
    "bound_states.api": ("spectrum",),
    "general_solution.boundary_problems": ("eigenvalues",),
    "decision": ("Status", "Structure"),
    "doubles.tabulate": ("tabulate",),
    "enclosure.ball": ("Ball",),
    "enclosure.evaluate": ("Prepared", "evaluate", "prepared"),
    "enclosure.monodromy": ("connection_matrix", "monodromy"),
    "enclosure.precision": ("AccuracyWarning",),
    "enclosure.request": ("Accuracy", "Start"),
    "equation": ("Equation",),
    "errors": (
        "UnsatisfiableConditions",
        "InputError",
        "KovacicError",
        "LimitExceeded",
        "MissingExtra",
        "NotLinear",
        "NotRational",
        "ParseError",
        "VerificationFailed",
    ),
    "general_solution": ("answer_to", "dsolve", "explain", "register", "solve_riccati", "unregister", "validity"),
    "limits": ("Limits",),
    "solution": ("Solution", "solve"),
    "solution.conditions": ("conditions",),
    "writing.code": ("as_code",),
}
_MODULES = {name: f"kovacic.{module}" for module, names in _PUBLIC_NAMES.items() for name in names}

__all__ = sorted(_MODULES)


def __getattr__(name: str) -> object:
    if name not in _MODULES:
        raise AttributeError(f"module 'kovacic' has no attribute {name!r}")
    from kovacic.errors import needs

    with needs("numeric", f"kovacic.{name}"):
        value = globals()[name] = getattr(import_module(_MODULES[name]), name)
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
