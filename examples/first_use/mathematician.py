"""A mathematician: Kovacic's first example, compared with the paper line by line, and an answer proven by other code.

pip install . && python examples/first_use/mathematician.py
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import kovacic
from kovacic.cli.main import run

example = kovacic.solve("(4*x^6 - 8*x^5 + 12*x^4 + 4*x^3 + 7*x^2 - 20*x + 4)/(4*x^4)")
print(example.explain())
print(example.citation())
assert example.case == 1
assert str(example.semi_invariant.P) == "x**2 - 1"  # the P of section 3.2

print(
    "\nThe same as a page for the browser, with formulas and a picture; and proven again by a checker that shares no code:"
)
with tempfile.TemporaryDirectory() as folder:
    page, answer = Path(folder, "example.html"), Path(folder, "answer.jsonl")
    page.write_text(example.explain(format="html"), encoding="utf-8")
    answer.write_text(example.to_json() + "\n", encoding="utf-8")
    print(f"  {page.name}: {page.stat().st_size} bytes")
    status = run(["check", str(answer)])
assert status == 0
