"""The paper's figures and its table: how each is made from commands of the tool, or why it cannot be made yet."""

import csv
import pathlib

from figure_overlays import baked, figure10, figure4, figure5, figure6, figure7, figure9

ROOT = pathlib.Path(__file__).resolve().parent.parent
# The paper's settings of an SPHL: its degree, and 64×64×6 texels.
DEGREE = 10


class Sizes:
    """Pixels and samples of all figures."""

    def __init__(self, quick):
        self.view = ["--width", 96, "--height", 54] if quick else ["--width", 480, "--height", 270]
        self.truth, self.spp, self.probe = (2, 1, 1) if quick else (512, 16, 64)
        self.lobe = 8 if quick else 96
        self.face, self.many = (8, 4) if quick else (64, 256)
        self.overlay_spp, self.photons, self.voxels = (1, 16, 8) if quick else (4, 128, 32)
        self.mesh = ["rays=16", "edge=2"] if quick else []
        self.surfels, self.records = (["surfel_size=0.5"], ["records=512"]) if quick else ([], [])
        self.plan = ["width=96", "height=54", "face=8"] if quick else []

    def paper(self):
        """ssphh-paper with these sizes."""
        return ["--method", "ssphh-paper", "--param", f"spp={self.probe}", "--param", f"viz_spp={self.probe}",
                "--param", f"face={self.face}", "--param", f"degree={DEGREE}", "--spp", self.spp]


def truth(figure, sizes, scene, name, look):
    figure.picture(name, "render", scene, *sizes.view, *look, "--max-depth", 25, "--spp", sizes.truth)


def figure1(figure, sizes):
    scene, look = "builtin:gallery2", ["--exposure", 0]
    figure.run("render", scene, *sizes.view, *look, "--max-depth", 1, "--spp", sizes.truth, "-o", "direct.exr", "--png", "direct.png")
    figure.run("render", scene, *sizes.view, *look, *sizes.paper(), "-o", "ssphh-paper.exr", "--png", "ssphh-paper.png")
    truth(figure, sizes, scene, "truth", look)
    figure.panels([[("direct.png", "(a) direct light alone"), ("ssphh-paper.png", "(b) the paper's SSPHH: GEN, VIZ, HIER, lookup light"),
                    ("truth.png", "(c) path tracing, depth 25")]])


def cube(figure, sizes, scene, name, depth, passes):
    """A light probe of six faces in a row."""
    figure.run("render", scene, "--projection", "cube", "--at", "middle", "--width", 6 * sizes.face, "--height", sizes.face, "--max-depth",
               depth, "--passes", passes, "--spp", 1, "--exposure", 0, "-o", f"{name}.exr", "--png", f"{name}.png")


def figure2(figure, sizes):
    figure.run("sh", "plot", "--degree", 10, "--size", sizes.lobe, "-o", "lobes.png")
    figure.panels([[("lobes.png", "Y_lm: row l from 0 at the top, column m from −10 to 10; blue positive, orange negative; the pole is up")]])


def figure3(figure, sizes):
    cube(figure, sizes, "builtin:gallery1", "strip", 3, sizes.many)
    figure.run("cubemap", "convert", "strip.exr", "--from", "strip-h", "--to", "cross-h", "-o", "probe.png")
    figure.run("sh", "project", "strip.exr", "--layout", "strip-h", "--degree", DEGREE, "-o", "sh.json")
    figure.run("sh", "reconstruct", "sh.json", "--layout", "cross-h", "--size", sizes.face, "-o", "sh.png")
    figure.panels([[("probe.png", f"(a) light probe, 6 faces of {sizes.face}×{sizes.face} texels, path traced to depth 3"),
                    ("sh.png", f"(b) the same as spherical harmonics of degree {DEGREE}; what is negative (ringing) is black")]])


def figure8(figure, sizes):
    baked(figure, sizes, "gallery1", DEGREE)
    figure.run("hier", "gallery1.sphl", "-o", "hier.sphl")
    figure.run("probe", "preview", "hier.sphl", "--edges", "middle", "--width", 4 * sizes.face, "-o", "edges.png")
    figure.panels([[("edges.png", "A row for each neighbour j of i = middle, the strongest first: S_i, H_{j→i}, S_j, H ⊗ S_j, and S_i with the "
                                  "products so far; the last row's is S'_i. Equirectangular, +y on top; S_i, S_j and sums share an exposure")]])


def figure11(figure, sizes):
    rows = []
    for scene in ("gallery1", "gallery2"):
        look = ["--exposure", 0]
        figure.run("render", f"builtin:{scene}", *sizes.view, *look, "--max-depth", 1, "--spp", sizes.truth, "-o", f"{scene}-direct.png")
        truth(figure, sizes, f"builtin:{scene}", scene, look)
        rows.append([(f"{scene}-direct.png", f"{scene}: direct light alone"), (f"{scene}.png", f"{scene}: path tracing, depth 25")])
    figure.panels(rows)


def figure12(figure, sizes):
    row = []
    for time in (0, 0.5, 1, 1.5):
        name = f"torch-{time}"
        truth(figure, sizes, "builtin:torch", name, ["--time", time, "--exposure", 0])
        row.append((f"{name}.png", f"{time} s"))
    tank = []
    for time in (0, 1):
        name = f"fishtank-{time}"
        truth(figure, sizes, "builtin:fishtank", name, ["--time", time])
        tank.append((f"{name}.png", f"caustics of a tank at {time} s"))
    figure.panels([row[:2], row[2:], tank])


def figure13(figure, sizes):
    rows, errors = [], []
    for scene, what in (("gallery1", "colour bleeding"), ("gallery3", "a complex model")):
        look = ["--exposure", 0]
        truth(figure, sizes, f"builtin:{scene}", f"{scene}-truth", look)
        figure.run("render", f"builtin:{scene}", *sizes.view, *look, *sizes.paper(), "-o", f"{scene}.exr", "--png", f"{scene}.png")
        row = [(f"{scene}.png", f"{scene} ({what}): the paper's SSPHH"), (f"{scene}-truth.png", "path tracing, depth 25")]
        for kind, what_map in (("absolute", "absolute error"), ("pixelated", "sum of it in blocks of 16×16 pixels")):
            found = figure.run("compare", f"{scene}-truth.exr", f"{scene}.exr", "--map", kind, "-o", f"{scene}-{kind}.png")
            row.append((f"{scene}-{kind}.png", f"{what_map}; the last colour is {found['map']['scale']:.3g}"))
        rows.append(row)
        errors.append((scene, f"{found['mae']:.4g}", f"{found['relmse']:.4g}", ", ".join(f"{r:.3f}" for r in found["mean_ratio"])))
    figure.panels(rows)
    figure.table(("scene", "mean absolute error", "relMSE", "ratio of means R, G, B"), errors)


def depths(figure, sizes, show):
    """Many passes, the difference, one pass; a row for each depth. `show` makes the picture NAME from the probe's file."""
    rows, scale = [], 0.5
    for depth in (0, 1, 3, 25):
        for name, passes in (("many", sizes.many), ("one", 1)):
            cube(figure, sizes, "builtin:gallery1", f"probe-{depth}-{name}", depth, passes)
        pair = [show(f"probe-{depth}-{name}") for name in ("many", "one")]
        figure.run("compare", f"{pair[0]}.exr", f"{pair[1]}.exr", "--map", "absolute", "--scale", scale, "-o", f"difference-{depth}.png")
        rows.append([(f"{pair[0]}.png", f"depth {depth}, {sizes.many} passes"),
                     (f"difference-{depth}.png", f"absolute difference; the last colour is {scale}"),
                     (f"{pair[1]}.png", f"depth {depth}, 1 pass")])
    figure.panels(rows)
    figure.note("Depth 0 is black: the SPHL sees none of the hidden lamps themselves.")


def figure14(figure, sizes):
    depths(figure, sizes, lambda name: name)


def figure15(figure, sizes):
    def show(name):
        figure.run("sh", "project", f"{name}.exr", "--layout", "strip-h", "--degree", DEGREE, "-o", f"{name}.json")
        for end in ("exr", "png"):
            figure.run("sh", "reconstruct", f"{name}.json", "--layout", "strip-h", "--size", sizes.face, "-o", f"{name}-sh.{end}")
        return f"{name}-sh"
    depths(figure, sizes, show)


def table1(figure, sizes):
    settings = [word for setting in sizes.plan for word in ("--set", setting)]
    figure.run("report", ROOT / "plans/table1.json", "-o", "report", "--cache", "cache", *settings)
    columns = ["REF.seconds", "GEN.gen_seconds", "GEN.viz_seconds", "HIER.seconds"]
    with open(figure.folder / "report/report.csv", newline="") as file:
        rows = [(r["scene"], r["parameter mrd"], r["parameter pl"], *(f"{float(r[c]):.3g}" for c in columns)) for r in csv.DictReader(file)]
    figure.table(("scene", "mrd", "pl", "REF [s]", "GEN [s]", "VIZ [s]", "HIER [s]"), rows)
    figure.note("mrd: maximum ray depth; pl: passes, of one sample a pixel. The paper's numbers are beside these in report/report.html.")


# name: (title, what it shows, how it is made)
FIGURES = {
    "1": ("Figure 1: global illumination by SSPHH", "Gallery 2, whose lamps are hidden.", figure1),
    "2": ("Figure 2: spherical harmonics of degree 0 to 10", "Lobes with colours of their sign; each as large as its cell lets it be.", figure2),
    "3": ("Figure 3: a light probe and its spherical harmonics", "The SPHL `middle` of gallery 1.", figure3),
    "4": ("Figure 4: irradiance volumes and PRT", "Gallery 1, 24 probes.", figure4),
    "5": ("Figure 5: virtual point lights", "Gallery 1.", figure5),
    "6": ("Figure 6: voxel cone tracing", "Gallery 1.", figure6),
    "7": ("Figure 7: the steps of SSPHH", "Gallery 1: the paper's way, and ours.", figure7),
    "8": ("Figure 8: S'_i from GEN and VIZ", "The SPHL `middle` of gallery 1, by the operator coefficient.", figure8),
    "9": ("Figure 9: hierarchies and previews of SPHLs", "Balls show the radiance of S'_i; what surfaces hide is dimmed.", figure9),
    "10": ("Figure 10: probes rendered elsewhere, sent as JSON", "A worker renders the probes of gallery 1; messages as they were sent.", figure10),
    "11": ("Figure 11: scenes that need indirect light", "What hidden lamps light directly, and all light.", figure11),
    "12": ("Figure 12: SPHLs as complex emitters", "A vault lit by a torch and by an SPHL that is a fire at four moments, and a tank whose waves refract its lamp's light at two, path traced.", figure12),
    "13": ("Figure 13: error of the paper's SSPHH", "SPHLs of depth 3 against path tracing of depth 25.", figure13),
    "14": ("Figure 14: ray depths and passes of a light probe", "The SPHL `middle` of gallery 1 as six faces +X −X +Y −Y +Z −Z.", figure14),
    "15": ("Figure 15: the same as spherical harmonics", "The probes of Figure 14 in degree 10; what is negative is black.", figure15),
    "table1": ("Table 1: seconds for REF, GEN, VIZ and HIER", "Four scenes with two settings each.", table1),
}
