"""Puts PNG pictures of one size side by side in one PNG file, with the standard library alone."""

import struct
import zlib


def read_png(path):
    """(width, height, rows of RGB bytes) of an 8-bit RGB or RGBA picture without interlacing."""
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            if depth != 8 or color not in (2, 6) or interlaced:
                raise ValueError(f"{path}: not a plain 8-bit RGB picture")
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    channels = 3 if color == 2 else 4
    stride = width * channels
    raw = zlib.decompress(packed)
    rows, above = [], bytes(stride)
    for y in range(height):
        start = y * (stride + 1)
        row = bytearray(raw[start + 1:start + 1 + stride])
        undo_filter(raw[start], row, above, channels)
        above = bytes(row)
        rows.append(b"".join(above[i:i + 3] for i in range(0, stride, channels)))
    return width, height, rows


def undo_filter(kind, row, above, channels):
    """PNG specification, section 9."""
    for i in range(len(row)):
        left = row[i - channels] if i >= channels else 0
        corner = above[i - channels] if i >= channels else 0
        if kind == 1:
            predicted = left
        elif kind == 2:
            predicted = above[i]
        elif kind == 3:
            predicted = (left + above[i]) // 2
        elif kind == 4:
            guess = left + above[i] - corner
            predicted = min((left, above[i], corner), key=lambda v: abs(guess - v))
        else:
            predicted = 0
        row[i] = (row[i] + predicted) & 255


def write_sheet(path, pictures, columns, gap=4):
    """Tiles row by row from the upper left; white between them and where the last row ends."""
    tiles = [read_png(picture) for picture in pictures]
    width, height = tiles[0][:2]
    white, lines = b"\xff\xff\xff", []
    total = columns * width + (columns - 1) * gap
    for first in range(0, len(tiles), columns):
        if first:
            lines += [white * total] * gap
        row = tiles[first:first + columns]
        for y in range(height):
            line = (white * gap).join(tile[2][y] for tile in row)
            lines.append(line + white * (total - len(line) // 3))
    previous, raw = bytes(3 * total), b""
    for line in lines:
        raw += b"\x02" + bytes((a - b) & 255 for a, b in zip(line, previous))
        previous = line

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", total, len(lines), 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw, 9)) +
                     chunk(b"IEND", b""))
