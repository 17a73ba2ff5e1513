"""Makes the fonts of report.html: python3 subset.py FOLDER, where FOLDER holds the originals.

Needs fontTools and brotli from PyPI, Libertinus Serif 7.051 (regular, italic, bold) as it stands in the
crate typst-assets 0.15.1, and Libertinus Math 7.040 as it stands in Debian's texlive-fonts-extra
2022.20230122. Originals that are missing are left as they are. Run once; the results are
committed. The block U+1D400-1D7FF has the italic, double-struck and other letters of MathML.
"""

import sys
from pathlib import Path

from fontTools.subset import Options, Subsetter, load_font, save_font

TEXT = "20-7E A0-17F 2B0-2FF 370-3FF 2010-2027 202F-203A 2044 2070-209F 20AC 2116 2122 2153-215E "
TEXT += "2190-2193 2200-2265 2308-230B 25A0-25CF 2713 FB00-FB04"
# Headings, names of figures and tables.
BOLD = "20-7E A0-FF 391-3C9 2010-2015 2018-201F 2026 202F 2070-2079 2080-2089 2153-215E 2190-2193 2212 2260-2265"
MATHS = "20-7E A0-FF 2C6-2DD 300-338 370-3FF 2010-2016 2020-2026 202F-2037 203E 2044 2057 2061-2064 "
MATHS += "20D0-20DC 2100-214F 2190-21FF 2200-22FF 2300-2312 23B0-23E1 2713 27E6-27EF 2A00-2A10 1D400-1D7FF"

FONTS = {
    "LibertinusSerif-Regular": TEXT,
    "LibertinusSerif-Italic": TEXT,
    "LibertinusSerif-Bold": BOLD,
    "LibertinusMath-Regular": MATHS,
}


def codes(ranges):
    for part in ranges.split():
        first, _, last = part.partition("-")
        yield from range(int(first, 16), int(last or first, 16) + 1)


def level(font):
    """Browsers lower a subscript with the descender of its letter, by this much more: p and n would not agree."""
    font["MATH"].table.MathConstants.SubscriptBaselineDropMin.Value = -40


def widen(font):
    """Browsers know no italic correction: without most of it in the width the next letter is touched."""
    correction = font["MATH"].table.MathGlyphInfo.MathItalicsCorrectionInfo
    letters = {name for code, name in font.getBestCmap().items() if 0x1D400 <= code <= 0x1D7FF}
    for name, value in zip(correction.Coverage.glyphs, correction.ItalicsCorrection):
        if name in letters:
            width, left = font["hmtx"][name]
            font["hmtx"][name] = (width + 2 * value.Value // 3, left)


for source, ranges in FONTS.items():
    options = Options()
    options.flavor = "woff2"
    options.layout_features = ["kern", "liga", "mark", "mkmk", "ccmp", "tnum", "lnum"]
    options.hinting = False
    options.name_IDs = [0, 1, 2, 3, 4, 5, 6, 13, 14, 16, 17]
    options.notdef_outline = True
    original = Path(sys.argv[1]) / f"{source}.otf"
    if not original.exists():
        continue
    font = load_font(str(original), options)
    font.recalcTimestamp = False
    subsetter = Subsetter(options)
    subsetter.populate(unicodes=list(codes(ranges)))
    subsetter.subset(font)
    if "MATH" in font:
        level(font)
        widen(font)
    save_font(font, str(Path(__file__).parent / f"{source}.woff2"), options)
