"""The first part of the demo's page: a probe file beside the truth, a door that opens, methods compared."""

import base64
import json

STYLE = """
.wipe { position: relative; --at: 50%; }
.wipe img { display: block; }
.wipe .over { position: absolute; inset: 0; clip-path: inset(0 0 0 var(--at)); }
.wipe .line { position: absolute; top: 0; bottom: 0; left: var(--at); width: 2px; margin-left: -1px; background: #fff; pointer-events: none; }
.wipe input { position: absolute; inset: 0; width: 100%; height: 100%; margin: 0; opacity: 0; cursor: ew-resize; }
.wipe:focus-within .line { background: #fc6; width: 4px; }
.side { display: grid; grid-template-columns: 2fr 1fr; gap: 1rem; align-items: center; }
.num { font-size: 1.6em; color: #fff; }
svg { max-width: 100%; }
"""

NAMES = {
    "ssphh": "ssphh",
    "ssphh-paper": "the paper's method, 6 SPHLs of the scene",
    "ddgi": "DDGI: a grid of probes with distances",
    "vct": "voxel cone tracing",
    "vpl": "virtual point lights",
    "irradiance-volume": "irradiance volume, tetrahedra without visibility",
    "ambient": "one constant",
}


def load(out, name):
    return json.loads((out / name).read_text())


def data(out, name, kind):
    return f"data:image/{kind};base64," + base64.b64encode((out / name).read_bytes()).decode()


def percent(x):
    return f"{100 * x:.1f} %" if abs(x) < 0.1 else f"{100 * x:.0f} %"


def colours(values):
    return " / ".join(f"{v:.3f}" for v in values)


def wipe(out):
    bake, path, lit, compared = (load(out, f"lead.{what}.json") for what in ("bake", "path", "ssphh", "compare"))
    file = next(r for r in load(out, "lead.methods.json")["results"] if "method" not in r)
    seconds = bake["gen_seconds"] + (bake["viz_seconds"] or 0) + (bake["record_seconds"] or 0)
    return f"""
<section><h2>A room lit by a probe file</h2>
<p>Left of the line path tracing, right of it direct light and what <code>ssphh bake</code> wrote. Drag the line, or use the arrow keys.</p>
<div class="wipe"><img src="{data(out, "lead.path.png", "png")}" alt="path tracing">
<img class="over" src="{data(out, "lead.ssphh.png", "png")}" alt="ssphh"><div class="line"></div>
<input type="range" min="0" max="100" step="0.5" value="50" aria-label="how much of the picture is path traced"
 oninput="this.parentNode.style.setProperty('--at', this.value + '%')"></div>
<p><span class="num">{percent(file["worst"]["mean_error"])}</span> mean error of indirect light at 256 points of all surfaces, the truth's noise taken off;
<span class="num">{seconds:.1f} s</span> for the bake of {bake["probes"]} probes and
{bake["records"]:,} surface records;
<span class="num">{colours(compared["mean_ratio"])}</span> of the red, green and blue of path tracing's picture, which took {path["seconds"]:.0f} s, this one {lit["seconds"]:.0f} s.</p></section>"""


def chart(times):
    """Milliseconds of each frame, as bars."""
    wide, high, most = 420, 150, max(times)
    step = wide / len(times)
    bars = "".join(f"<rect x='{i * step + 1:.1f}' y='{high * (1 - t / most):.1f}' width='{step - 2:.1f}' height='{high * t / most:.1f}' "
                   f"fill='#69c'><title>frame {i}: {t:.1f} ms</title></rect>" for i, t in enumerate(times))
    return (f"<svg viewBox='0 -20 {wide} {high + 22}' role='img' aria-label='milliseconds of each frame'>{bars}"
            f"<text x='0' y='-6' fill='#ddd' font-size='13'>relighting, ms a frame; the highest {most:.0f}</text></svg>")


def door(out):
    run = load(out, "door.json")
    times = run["frame_ms"]
    return f"""
<section><h2>Lamps and doors move</h2>
<div class="side"><figure><img src="{data(out, "door.webp", "webp")}" alt="a door opens and the lamp behind it moves">
<figcaption>A door opens onto a lit room, then its lamp moves: every frame's indirect light is new, all bounces of it.</figcaption></figure>
<div>{chart(times)}<p>Half of the frames took less than {run["median_ms"]:.0f} ms on the processor.</p></div></div></section>"""


def methods(out):
    rows = ""
    results = [r for r in load(out, "lead.methods.json")["results"] if "method" in r]
    for r in sorted(results, key=lambda r: r["worst"]["mean_error"]):
        rows += (f"<tr><td>{NAMES[r['method']]}</td><td>{percent(r['worst']['mean_error'])}</td><td>{colours(r['ratio'])}</td>"
                 f"<td>{r['bake_seconds'] + r['update_seconds']:.1f}</td><td>{r['lookup_bytes'] / 1e3:,.0f}</td><td>{r['lookup_us']:.1f}</td></tr>")
    return f"""
<section><h2>Methods compared</h2>
<p>The same scene, 256 points of all its surfaces, against path tracing to depth 16; every method at its defaults, made here on the processor, worst channel.
More scenes, pictures and edges: docs/comparison.md.</p>
<table><tr><th>method</th><th>mean error</th><th>share of the light, R / G / B</th><th>until lit [s]</th><th>memory [kB]</th><th>a lookup [µs]</th></tr>{rows}</table></section>"""


def lead(out):
    return wipe(out) + door(out) + methods(out)
