"""Makes the fonts of the formulas: python3 book/math_fonts.py STIXTwoMath-Regular.ttf (needs fonttools and brotli).

The first contains the characters of src/math/characters.txt. The second contains their slanted letters in place of the
upright ones, for figures and labels, which are not MathML.
"""
import pathlib
import sys

from fontTools import subset, ttLib

FOLDER = pathlib.Path(__file__).parent / "src" / "math"


def save(font, characters, name):
    subsetter = subset.Subsetter(subset.Options(layout_features=[], desubroutinize=True))
    subsetter.populate(text=characters)
    subsetter.subset(font)
    font.flavor = "woff2"
    font.save(FOLDER / name)


def slanted():
    """Yields each letter with its slanted form."""
    for first, last, form in [("A", "Z", 0x1D434), ("a", "z", 0x1D44E), ("Α", "Ω", 0x1D6E2), ("α", "ω", 0x1D6FC)]:
        for k in range(ord(last) - ord(first) + 1):
            # The slanted h is older than the others.
            yield chr(ord(first) + k), "ℎ" if chr(ord(first) + k) == "h" else chr(form + k)


font = ttLib.TTFont(sys.argv[1], recalcTimestamp=False)
for table in font["cmap"].tables:
    # Only Firefox replaces the prime by its form for superscripts.
    table.cmap[ord("′")] = "minute.ssty"
save(font, (FOLDER / "characters.txt").read_text(), "STIXTwoMath.woff2")

font = ttLib.TTFont(sys.argv[1], recalcTimestamp=False)
glyphs = font.getBestCmap()
letters = {ord(letter): glyphs[ord(form)] for letter, form in slanted()}
for table in font["cmap"].tables:
    table.cmap = letters
del font["MATH"]
save(font, "".join(map(chr, letters)), "STIXTwoMath-Italic.woff2")
