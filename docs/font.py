"""The font of the formulas: a subset of STIX Math that is shipped with the package, as kovacic/writing/math.woff2.

    python docs/font.py STIXMath-Regular.otf

It has what our formulas contain, in the sizes of the font's table MATH.  The license of the font, the SIL Open Font License
1.1, reserves its name; the subset has another one.  Needs fonttools and brotli.
"""

from __future__ import annotations

import sys
from pathlib import Path

NAME = "kovacic math"
TARGET = Path(__file__).parent.parent / "kovacic" / "writing" / "math.woff2"

#: What MathML draws single letters with: italic Latin and Greek ones, and those with a double stroke.
ITALIC = [*range(0x1D434, 0x1D468), 0x210E, *range(0x1D6E2, 0x1D71C)]
DOUBLE_STRUCK = [0x2102, 0x2115, 0x2119, 0x211A, 0x211D, 0x2124, *range(0x1D538, 0x1D56C)]
PLAIN = [*range(0x20, 0x7F), *range(0x391, 0x3CA), 0xA0, 0xB1, 0xB7, 0xD7]
SIGNS = "−±×·⋅∓∕√∛∜∑∏∫∂∞∈∉⊂⊆⊃∪∩≠≤≥≈≡∼≅→↦⇒∀∃∅′″‴…⋯⟨⟩⌊⌋⌈⌉∣‖⋊⋉∘∗ℏℓ℘ℜℑϵϑϕϖϱς⁡⁢⁣"


def build(source: str) -> None:
    """The subset, under its own name."""
    from fontTools.subset import Options, Subsetter
    from fontTools.ttLib import TTFont

    font = TTFont(source)
    options = Options(flavor="woff2", hinting=False, desubroutinize=True, name_IDs=[0, 1, 2, 3, 4, 5, 6, 13, 14])
    options.layout_features = ["ssty", "dtls", "flac", "kern", "mark", "ccmp"]
    subsetter = Subsetter(options)
    subsetter.populate(unicodes=[*ITALIC, *DOUBLE_STRUCK, *PLAIN, *map(ord, SIGNS)])
    subsetter.subset(font)
    for record in font["name"].names:
        if record.nameID in (1, 3, 4):
            record.string = NAME
        elif record.nameID == 6:
            record.string = NAME.replace(" ", "-")
    if "CFF " in font:
        font["CFF "].cff.fontNames = [NAME.replace(" ", "-")]
        top = font["CFF "].cff.topDictIndex[0]
        top.FullName = top.FamilyName = NAME
    font.flavor = "woff2"
    font.save(TARGET)
    print(f"{TARGET}: {TARGET.stat().st_size} bytes")


if __name__ == "__main__":
    build(sys.argv[1])
