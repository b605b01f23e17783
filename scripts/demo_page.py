#!/usr/bin/env python3
"""Makes out/demo/index.html from the files that scripts/demo wrote: demo_page.py DIR SCENE..."""

import base64
import html
import json
import pathlib
import platform
import subprocess
import sys

import demo_lead

# Metzgar & Semwal, Table 1, rows with maximum ray depth 3 and pass limit 1 (seconds; Corona Renderer, CPU not stated).
PAPER = {
    "gallery1": ("Gallery 1", 15.03, 48.40, 197.46, 0.91512),
    "sponza": ("Sponza", 21.88, 55.60, 178.34, 0.48255),
}
VARIANTS = [
    ("self", "ssphh, each probe's own light"),
    ("mean", "ssphh, HIER with operator mean"),
    ("coefficient", "ssphh, HIER with operator coefficient (the paper's)"),
    ("light", "ssphh, lookup light (the paper's I = L/(N·L))"),
    ("direct", "direct light only"),
]

out = pathlib.Path(sys.argv[1])
scenes = sys.argv[2:]


def load(name):
    return json.loads((out / name).read_text())


def picture(name, title):
    data = base64.b64encode((out / name).read_bytes()).decode()
    return (f'<figure><img src="data:image/png;base64,{data}" alt="{html.escape(title)}">'
            f"<figcaption>{html.escape(title)}</figcaption></figure>")


def table(head, rows):
    cells = lambda row, tag: "<tr>" + "".join(f"<{tag}>{c}</{tag}>" for c in row) + "</tr>"
    return "<table>" + cells(head, "th") + "".join(cells(row, "td") for row in rows) + "</table>"


def machine():
    cpu = platform.machine()
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            cpu = line.split(":", 1)[1].strip()
            break
    cores = subprocess.run(["nproc"], capture_output=True, text=True).stdout.strip()
    return f"{cpu}, {cores} cores"


def commit():
    run = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True)
    return run.stdout.strip() or "unknown"


def section(name):
    info, bake, hier = load(f"{name}.info.json"), load(f"{name}.bake.json"), load(f"{name}.hier.json")
    path = load(f"{name}.path.json")
    times = [("this project", f"{path['seconds']:.2f}", f"{bake['gen_seconds']:.2f}", f"{bake['viz_seconds']:.2f}",
              f"{hier['seconds']:.6f}")]
    if name in PAPER:
        title, ref, gen, viz, hier_seconds = PAPER[name]
        times.append((f"the paper, {title} (mrd 3, pl 1)", ref, gen, viz, hier_seconds))
    errors = []
    for variant, label in VARIANTS:
        c = load(f"{name}.{variant}.compare.json")
        r = load(f"{name}.{variant}.json")
        ratio = ", ".join(f"{x:.3f}" for x in c["mean_ratio"])
        errors.append((label, f"{r['seconds']:.2f}", f"{c['mae']:.4g}", f"{c['rmse']:.4g}", f"{c['relmse']:.4g}",
                       f"{c['mape']:.4g}", ratio))
    return "".join([
        f"<section><h3>{name}</h3>",
        f"<p>{info['triangles']:,} triangles, {info['lights']} lights, {bake['probes']} SPHLs of 64×64×6 texels, "
        f"16 samples per texel.</p>",
        '<div class="pair">',
        picture(f"{name}.path.png", f"ground truth: path tracing, depth 4, {path['seconds']:.1f} s"),
        picture(f"{name}.self.png", "ssphh: direct light + probes (self), lookup irradiance"),
        "</div><div class=pair>",
        picture(f"{name}.self.absolute.png", "absolute error"),
        picture(f"{name}.self.pixelated.png", "pixelated: sum of absolute error in 16×16 blocks"),
        "</div>",
        "<h4>Times in seconds, as the paper's Table 1</h4>",
        table(("", "REF", "GEN", "VIZ", "HIER"), times),
        "<p>REF: 1280×720. The paper's figures are for another machine, renderer and scene of the same kind.</p>",
        "<h4>Error against the ground truth</h4>",
        table(("method", "seconds", "MAE", "RMSE", "relMSE", "MAPE", "ratio of means R, G, B"), errors),
        "<p>The two HIER operators add neighbours' light to probes that already hold every bounce, so they are expected "
        "to be too bright: libs/methods/ssphh/README.md.</p>",
        '<div class="pair">',
        picture(f"{name}.direct.png", "direct light only"),
        picture(f"{name}.coefficient.png", "ssphh: HIER with operator coefficient"),
        "</div><div class=pair>",
        picture(f"{name}.mean.png", "ssphh: HIER with operator mean"),
        picture(f"{name}.light.png", "ssphh: lookup light"),
        "</div>",
        "<h4>Probes</h4>",
        picture(f"{name}.probes.png", "one row a probe: self, neighbours, sum (operator coefficient)"),
        "</section>",
    ])


page = f"""<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>ssphh</title>
<style>
body {{ font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 90rem; padding: 0 1rem; background: #111; color: #ddd; }}
.pair {{ display: grid; grid-template-columns: 1fr 1fr; gap: 1rem; }}
figure {{ margin: 0 0 1rem; }} img {{ width: 100%; background: #000; }} figcaption {{ color: #aaa; }}
table {{ border-collapse: collapse; margin: .5rem 0 1rem; }} td, th {{ border: 1px solid #444; padding: .2rem .7rem; text-align: right; }}
td:first-child, th:first-child {{ text-align: left; }} a {{ color: #8bf; }}
{demo_lead.STYLE}</style>
<h1>ssphh</h1>
<p>Made by <code>scripts/demo</code> at commit {commit()} on {html.escape(machine())}.</p>
{demo_lead.lead(out)}
<h2>The paper's chain, step by step</h2>
{"".join(section(name) for name in scenes)}
</html>
"""
(out / "index.html").write_text(page)
print(f"page:   {(out / 'index.html').resolve()}")
print(f"images: {(out / 'lead').resolve()}.path.png .ssphh.png; {(out / 'door.webp').resolve()}")
for name in scenes:
    print(f"images: {(out / name).resolve()}.path.png .self.png .coefficient.png .self.absolute.png .probes.png")
