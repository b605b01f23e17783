"""Draws lines over numeric axes as an SVG file, with the standard library alone."""

import math

COLORS = ["#1b6ca8", "#b03a2e", "#2e8b57", "#7d3c98", "#c77c11", "#444444", "#1aa6a6", "#a0522d"]
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 720, 360, 70, 150, 34, 46


def ticks(low, high, log):
    if log:
        return [10.0 ** e for e in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) if low <= 10.0 ** e <= high]
    step = 10 ** math.floor(math.log10((high - low) / 4))
    step *= next(f for f in (1, 2, 5, 10) if (high - low) / (f * step) <= 6)
    return [step * i for i in range(math.ceil(low / step), math.floor(high / step) + 1)]


def axis(values, log):
    """A map to 0..1 with its range."""
    usable = [v for v in values if v > 0] if log else values
    low, high = (min(usable), max(usable)) if usable else (1, 10)
    if log:
        low, high = low / 1.2, high * 1.2
        return low, high, lambda v: (math.log(max(v, low)) - math.log(low)) / (math.log(high) - math.log(low))
    low = min(0, low)
    high = high * 1.05 if high > low else low + 1
    return low, high, lambda v: (v - low) / (high - low)


def label(value):
    return f"{value / 1e6:g}M" if value >= 1e6 else f"{value / 1e3:g}k" if value >= 1e4 else f"{value:g}"


def write_chart(path, title, x_title, y_title, lines, log_x=False, log_y=False, names=()):
    """`lines`: {name: [(x, y), …]}. `names`: all that charts of one page show, so that a name has one colour in all of them."""
    names = list(names) or list(lines)
    points = [p for line in lines.values() for p in line]
    x_low, x_high, to_x = axis([p[0] for p in points], log_x)
    y_low, y_high, to_y = axis([p[1] for p in points], log_y)
    px = lambda v: LEFT + to_x(v) * (WIDTH - LEFT - RIGHT)
    py = lambda v: HEIGHT - BOTTOM - to_y(v) * (HEIGHT - TOP - BOTTOM)
    out = [f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {WIDTH} {HEIGHT}' font-family='sans-serif' font-size='12'>",
           f"<rect width='{WIDTH}' height='{HEIGHT}' fill='white'/>", f"<text x='{LEFT}' y='20' font-size='14'>{title}</text>"]
    for v in ticks(x_low, x_high, log_x):
        out.append(f"<path d='M{px(v):.1f} {TOP}V{HEIGHT - BOTTOM}' stroke='#ddd'/>"
                   f"<text x='{px(v):.1f}' y='{HEIGHT - BOTTOM + 16}' text-anchor='middle'>{label(v)}</text>")
    for v in ticks(y_low, y_high, log_y):
        out.append(f"<path d='M{LEFT} {py(v):.1f}H{WIDTH - RIGHT}' stroke='#ddd'/>"
                   f"<text x='{LEFT - 6}' y='{py(v) + 4:.1f}' text-anchor='end'>{label(v)}</text>")
    out.append(f"<text x='{(LEFT + WIDTH - RIGHT) / 2}' y='{HEIGHT - 8}' text-anchor='middle'>{x_title}</text>")
    out.append(f"<text transform='translate(16 {(TOP + HEIGHT - BOTTOM) / 2}) rotate(-90)' text-anchor='middle'>{y_title}</text>")
    for i, (name, line) in enumerate(lines.items()):
        color = COLORS[names.index(name) % len(COLORS)]
        out.append(f"<polyline fill='none' stroke='{color}' stroke-width='1.6' points='"
                   + " ".join(f"{px(x):.1f},{py(y):.1f}" for x, y in line) + "'/>")
        out += [f"<circle cx='{px(x):.1f}' cy='{py(y):.1f}' r='2.5' fill='{color}'/>" for x, y in line if len(line) <= 12]
        out.append(f"<text x='{WIDTH - RIGHT + 12}' y='{TOP + 14 + 18 * i}' fill='{color}'>{name}</text>")
    path.write_text("\n".join(out) + "\n</svg>\n")
