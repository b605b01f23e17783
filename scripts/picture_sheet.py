"""Puts pictures of one size side by side in one file, each under its name."""

from PIL import Image, ImageDraw, ImageFont

LABEL, GAP = 20, 4


def write_sheet(path, tiles, columns):
    """Tiles, (picture file, name) each, row by row from the upper left; None leaves its place empty. WebP is lossy, PNG is not."""
    width, height = Image.open(next(tile for tile in tiles if tile)[0]).size
    across, down = width + GAP, height + LABEL + GAP
    sheet = Image.new("RGB", (columns * across - GAP, -(-len(tiles) // columns) * down - GAP), "white")
    font = ImageFont.truetype("DejaVuSans.ttf", 13)
    draw = ImageDraw.Draw(sheet)
    for i, tile in enumerate(tiles):
        if not tile:
            continue
        picture, name = tile
        x, y = i % columns * across, i // columns * down
        draw.text((x + 2, y + LABEL - 4), name, fill="black", font=font, anchor="ls")
        sheet.paste(Image.open(picture).convert("RGB"), (x, y + LABEL))
    sheet.save(path, quality=88, method=6)
