"""Figures 4 to 7, 9 and 10: what methods hold, drawn over their pictures, and the messages of a job."""

import json


def overlay(figure, sizes, name, method, draw=None, parameters=(), scene="builtin:gallery1", more=()):
    """The picture NAME.png of a method, with what it holds drawn over it."""
    words = [word for parameter in parameters for word in ("--param", parameter)]
    figure.run("render", scene, *sizes.view, "--exposure", 0, "--method", method, *words, "--spp", sizes.overlay_spp, *more,
               *(["--draw", draw] if draw else []), "-o", f"{name}.png")


def figure4(figure, sizes):
    probes = ["probes=24", *sizes.surfels]
    overlay(figure, sizes, "tetrahedra", "irradiance-volume", "tetrahedra", probes)
    overlay(figure, sizes, "volume", "irradiance-volume", None, probes)
    overlay(figure, sizes, "transfer", "prt", "transfer", [*probes, *sizes.mesh])
    overlay(figure, sizes, "prt", "prt", None, [*probes, *sizes.mesh])
    figure.panels([[("tetrahedra.png", "(a) radiance probes and the Delaunay tetrahedra between them; dimmed: behind surfaces"),
                    ("volume.png", "irradiance interpolated within the tetrahedra, without visibility")],
                   [("transfer.png", "(b) transfer vectors of some vertices: how much light from each direction becomes irradiance"),
                    ("prt.png", "(c) precomputed radiance transfer with them")]])


def figure5(figure, sizes):
    photons = f"photons={sizes.photons}"
    for name, depth in (("first", 2), ("all", 25)):
        overlay(figure, sizes, name, "vpl", "photons", [photons, f"depth={depth}"])
    overlay(figure, sizes, "vpl", "vpl", None, [photons])
    overlay(figure, sizes, "clamped", "vpl", None, [photons, "clamp=0.2"])
    figure.panels([[("first.png", f"(a) {sizes.photons} photons where they first met surfaces, and the surfaces' normals"),
                    ("all.png", "(b) after any number of reflections; each is a light, its area grows with its power")],
                   [("vpl.png", "(c) light of all of them, by shadow rays"), ("clamped.png", "the same with the hot spots bounded more (clamp=0.2)")]])


def figure6(figure, sizes):
    grid = f"resolution={sizes.voxels}"
    for name, bounces in (("direct", 1), ("bounced", 6)):
        overlay(figure, sizes, name, "vct", "voxels", [grid, f"bounces={bounces}"])
    overlay(figure, sizes, "vct", "vct", None, [grid])
    overlay(figure, sizes, "finer", "vct", None, [f"resolution={2 * sizes.voxels}"])
    figure.panels([[("direct.png", f"(a) voxels that lamps light, {sizes.voxels} along the longest edge"),
                    ("bounced.png", "after 6 bounces from voxel to voxel")],
                   [("vct.png", "(b) surfaces lit by cones through the voxels"), ("finer.png", "the same with voxels of half the edge")]])


def baked(figure, sizes, scene, degree):
    """SPHLs by the paper's GEN and VIZ."""
    figure.run("bake", f"builtin:{scene}", "--probes", "scene", "--degree", degree, "--face", sizes.face, "--spp", sizes.probe, "--max-depth", 3,
               "--viz", "path", "--viz-paths", "diffuse", "--viz-max-depth", 3, "--viz-spp", sizes.probe, "-o", f"{scene}.sphl")


def hierarchy(figure, sizes, scene, name, neighbors, draw="hierarchy"):
    """The picture NAME.png lit by SPHLs that took so many neighbours."""
    figure.run("hier", f"{scene}.sphl", "--neighbors", neighbors, "-o", f"{name}.sphl")
    overlay(figure, sizes, name, "ssphh", draw, scene=f"builtin:{scene}", more=["--probes", f"{name}.sphl", "--lookup", "light"])


def figure7(figure, sizes, degree=10):
    baked(figure, sizes, "gallery1", degree)
    hierarchy(figure, sizes, "gallery1", "sphls", 0)
    hierarchy(figure, sizes, "gallery1", "edges", -1)
    hierarchy(figure, sizes, "gallery1", "light", -1, None)
    for draw in ("surfels", "links"):
        overlay(figure, sizes, draw, "ssphh", draw, [*sizes.surfels, *sizes.records])
    overlay(figure, sizes, "ssphh", "ssphh", None, [*sizes.surfels, *sizes.records])
    figure.panels([[("sphls.png", "(a) SPHLs, each path traced: balls of the radiance that they see"),
                    ("edges.png", "(b) what they add to each other (HIER): wide and yellow edges where P is large"),
                    ("light.png", "the picture, lookup light")],
                   [("surfels.png", "our transport: surfels in their albedo"), ("links.png", "links of six surfels, white where many rays go"),
                    ("ssphh.png", "the picture, method ssphh")]])


def figure9(figure, sizes, degree=10):
    rows = []
    for scene in ("gallery1", "gallery2"):
        baked(figure, sizes, scene, degree)
        hierarchy(figure, sizes, scene, f"{scene}-all", -1)
        hierarchy(figure, sizes, scene, f"{scene}-two", 2)
        rows.append([(f"{scene}-all.png", f"{scene}: all edges, wide and yellow where P is large"), (f"{scene}-two.png", "two neighbours each (N' = 2)")])
    figure.panels(rows)
    figure.run("probe", "preview", "gallery1-all.sphl", "--width", 4 * sizes.face, "-o", "previews.png")
    figure.panels([[("previews.png", "SPHLs of gallery1: S_i, what neighbours add, and the sum S'_i; equirectangular")]])


def excerpt(text, most=1400):
    return text if len(text) <= most else text[:most] + f" … ({len(text)} bytes)"


def figure10(figure, sizes, degree=10):
    for old in (figure.folder / "messages").glob("*.json"):
        old.unlink()
    figure.run("render", "builtin:gallery1", "--projection", "cube", "--at", "middle", "--width", 6 * sizes.face, "--height", sizes.face,
               "--max-depth", 3, "--spp", sizes.probe, "--exposure", 0, "-o", "probe.exr", "--png", "probe.png")
    figure.run("sh", "project", "probe.exr", "--layout", "strip-h", "--degree", degree, "-o", "sh.json")
    figure.run("sh", "reconstruct", "sh.json", "--layout", "strip-h", "--size", sizes.face, "-o", "sh.png")
    figure.run("bake", "builtin:gallery1", "--probes", "scene", "--degree", degree, "--face", sizes.face, "--spp", sizes.probe, "--max-depth", 3,
               "--viz", "off", "--local", 1, "--cache", "none", "--keep-messages", "messages", "-o", "gallery1.sphl")
    figure.panels([[("probe.png", "(a) a probe with the settings that the worker is sent"), ("sh.png", f"(b) as spherical harmonics of degree {degree}: what the worker sends back")]])
    kept = sorted((figure.folder / "messages").glob("*.json"))
    figure.table(("message", "kind", "probes", "bytes"), [(path.name, (body := json.loads(path.read_text()))["kind"], len(body["probes"]),
                                                         path.stat().st_size) for path in kept])
    for what in ("job", "result"):
        first = next(path for path in kept if path.name.endswith(f".{what}.json"))
        figure.text(f"{first.name}, valid by schemas/farm-{what}.schema.json", excerpt(first.read_text()))
