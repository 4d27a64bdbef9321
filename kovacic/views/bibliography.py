"""The literature, and the references that an answer rests on.

`references.bib`, next to this file, has the publications; the field `use` says what this package uses each for.
"""

from __future__ import annotations

import pkgutil
import re
from functools import cache

from kovacic import derived
from kovacic.answer import Answer, was_computed
from kovacic.decision import NoInvariant, NoRationalOmega, Structure


class Reference(dict[str, str]):
    """One publication: the fields of its BibTeX entry, its `key`, and its `use` in this package."""

    def text(self) -> str:
        where = f"{self['journal']} {self.get('volume', '')}".strip()
        if "pages" in self:
            where += f", {self['pages']}"
        authors = self["author"].replace(" and ", ", ")
        published = f"{where.replace('--', '-')} ({self['year']})"
        if "doi" in self:
            published += f", doi {self['doi']}"
        return f"[{self['key']}] {authors}, {self['title']}, {published}: {self['use']}."

    def bibtex(self) -> str:
        names = ("author", "title", "journal", "volume", "pages", "year", "doi")
        fields = ",\n".join(f"  {name} = {{{self[name]}}}" for name in names if name in self)
        return f"@article{{{self['key']},\n{fields}\n}}"


@cache
def literature() -> dict[str, Reference]:
    """All publications, by their keys."""
    text = (pkgutil.get_data("kovacic.views", "references.bib") or b"").decode("utf-8")
    entries = re.findall(r"^@article\{(\w+),\n(.*?)\n\}", text, re.DOTALL | re.MULTILINE)
    return {key: Reference(re.findall(r"(\w+) = \{(.*)\}", body), key=key) for key, body in entries}


def references(answer: Answer) -> tuple[Reference, ...]:
    """The publications that the answer rests on, and those of its group if that was computed."""
    used = ["Kov86"]
    decision = answer.decision
    kinds = {type(evidence) for exclusion in decision.exclusions for evidence in exclusion.evidence}
    has_invariant = decision.invariant is not None
    has_omega = decision.structure is Structure.REDUCIBLE and decision.series is None
    if has_invariant or NoInvariant in kinds:
        used += ["UW96", "HW97"]
    if NoRationalOmega in kinds or (has_omega and not has_invariant):
        used += ["vH97", "CvH04"]
    elif has_omega:
        used.append("HvdP95")
    if answer.case == 3:
        used.append("SU93")
        if was_computed(derived.closed_form, answer):
            used.append("HW05")
    # Citing computes nothing: the answer doesn't rest on a group that wasn't computed.
    group = derived.group(answer) if was_computed(derived.group, answer) else None
    if group is not None and group.ground.name in ("NOT_TORSION", "FUNCTION", "HOLOMORPHIC_REST"):
        used += ["Dav81", "Can87"]
    return tuple(literature()[key] for key in used)


def citation(answer: Answer, *, style: str = "text") -> str:
    """The references of an answer, one a line, or as BibTeX (`style="bibtex"`)."""
    if style == "text":
        return "\n".join(reference.text() for reference in references(answer))
    if style == "bibtex":
        return "\n\n".join(reference.bibtex() for reference in references(answer))
    raise ValueError(f"unknown style {style!r}; available: 'text', 'bibtex'")
