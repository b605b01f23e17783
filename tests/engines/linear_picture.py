"""Takes the picture out of a page that three.html left: linear_picture.py PAGE OUT.hdr (RGBE, not packed); or tells the mean of one in shares
of another's: linear_picture.py PAGE PAGE."""

import math
import pathlib
import re
import sys

WIDTH, HEIGHT = 480, 270


def picture_in(page):
    text = pathlib.Path(page).read_text()
    found = re.search(r"LINEAR ([-\d.e+ ]+) END", text)
    if not found:
        sys.exit(f"{page}: holds no picture: {text[text.find('ERROR'):][:300]}")
    return [float(word) for word in found[1].split()]


values = picture_in(sys.argv[1])
if sys.argv[2].endswith(".html"):
    print(f"{sum(values) / sum(picture_in(sys.argv[2])):.2e}")
    sys.exit()
pixels = bytearray()
for i in range(0, len(values), 3):
    colour = values[i:i + 3]
    exponent = math.frexp(max(max(colour), 1e-30))[1]
    pixels += bytes(min(255, max(0, round(c * 256 / 2.0**exponent))) for c in colour) + bytes([exponent + 128])
header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n".encode()
pathlib.Path(sys.argv[2]).write_bytes(header + pixels)
