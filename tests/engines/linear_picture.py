"""Takes the picture out of a page that three.html left: linear_picture.py PAGE OUT.hdr (RGBE, not packed)."""

import math
import pathlib
import re
import sys

WIDTH, HEIGHT = 480, 270
page = pathlib.Path(sys.argv[1]).read_text()
found = re.search(r"LINEAR ([-\d.e+ ]+) END", page)
if not found:
    sys.exit(f"{sys.argv[1]}: holds no picture: {page[page.find('ERROR'):][:300]}")
values = [float(word) for word in found[1].split()]
pixels = bytearray()
for i in range(0, len(values), 3):
    colour = values[i:i + 3]
    exponent = math.frexp(max(max(colour), 1e-30))[1]
    pixels += bytes(min(255, max(0, round(c * 256 / 2.0**exponent))) for c in colour) + bytes([exponent + 128])
header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n".encode()
pathlib.Path(sys.argv[2]).write_bytes(header + pixels)
