"""Scans: the case and the group of y'' = S(x; n, ...) y over grids of exact parameter values.

    grid    exact values, and their substitution into the text of S
    table   the points as items of a batch, and rows of a table
    map     a picture of a scan over two parameters

>>> from kovacic.scan import parse_grid, scan
>>> records = scan("(4*n^2 - 1)/(4*x^2) - 1", [parse_grid("n=0:2:1/2")], jobs=1)
>>> [(record.data["parameters"]["n"], record.case) for record in records]
[('0', None), ('1/2', 1), ('1', None), ('3/2', 1), ('2', None)]
"""

from kovacic.scan.grid import Grid, parse_grid, substitute
from kovacic.scan.table import scan, scan_items

__all__ = ["Grid", "parse_grid", "scan", "scan_items", "substitute"]
