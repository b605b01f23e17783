"""Bakes of Python have the bits of the tool's."""

import unittest

import ssphh
from support import InAFolder, error_of, run_tool

# Arguments of both. Every default is at work in one of the first two, which leave out what takes longest.
CASES = [
    ("builtin:box", dict(face=4, surfel_size=0.2)),
    ("builtin:box", dict(spp=1, degree=1, records=16, link_rays=8)),
    ("builtin:cornell", dict(spp=2, face=8, degree=3, seed=7, max_depth=4, passes=2, neighbors=2, threshold=0.001)),
    ("builtin:cornell", dict(operator="surfel", quality="draft", directions=64, surfel_size=0.2, link_rays=16, records=64,
                             degree=2, fit=True, viz="links")),
    ("builtin:two-rooms", dict(probes=9, time=0.5, spp=1, face=4, degree=2, viz="off", records=0, clearance=0.1)),
    ("builtin:cornell", dict(spp=2, face=4, degree=1, records=0, viz_source="radiance", viz_paths="diffuse", viz_max_depth=2,
                             viz_passes=2, viz_spp=1)),
    ("builtin:cornell", dict(gen="local", spp=1, face=4, degree=1, viz_transfer=True)),
]


def as_options(keywords):
    options = []
    for name, value in keywords.items():
        options.append("--" + name.replace("_", "-"))
        if value is not True:
            options.append(str(value))
    return options


class Bakes(InAFolder):
    def test_same_bits_as_the_tool(self):
        for scene, keywords in CASES:
            with self.subTest(scene=scene, **keywords):
                run_tool("bake", scene, "-o", self.path("tool.sphl"), *as_options(keywords))
                here = dict(keywords)
                loaded = ssphh.load(scene, time=here.pop("time", 0))
                probes = ssphh.bake(loaded, self.path("python.sphl"), **here)
                self.assertEqual(self.bytes_of("python.sphl"), self.bytes_of("tool.sphl"))
                self.assertEqual(probes, ssphh.ProbeSet.load(self.path("tool.sphl"), loaded))

    def test_decides_by_the_number_of_probes_and_says_so(self):
        scene = ssphh.load("builtin:box")
        with self.assertLogs("ssphh", "INFO") as log:
            probes = ssphh.bake(scene, probes=65, degree=1, directions=16, link_rays=4, surfel_size=0.5, records=0)
        self.assertEqual(probes.generator["operator"], "surfel")
        self.assertIn("65 probes are lit by transport", log.output[0])
        self.assertIn("operator path traces", log.output[0])

    def test_refuses_what_would_have_no_effect_by_the_names_of_python(self):
        scene = ssphh.load("builtin:box")
        for keywords, where, said in (
            (dict(viz="off", threshold=0.5), "threshold", "viz links"),
            (dict(operator="surfel", spp=4), "spp", "operator path"),
            (dict(spp=4, viz="path", link_rays=4, records=0), "link_rays", "operator surfel"),
            (dict(viz_transfer=True, viz="links"), "viz_transfer", "viz path"),
            (dict(viz="links", viz_spp=1), "viz_spp", "viz path"),
            (dict(operator="surfl"), "operator", "surfel"),
            (dict(quality="better"), "quality", "best"),
            (dict(gen="all"), "gen", "local"),
            (dict(degree=11), "degree", "0..10"),
            (dict(probes="everywhere"), "probes", "auto"),
            (dict(output="x.exr"), "x.exr", ".sphl"),
        ):
            with self.subTest(**keywords):
                e = error_of(self, ssphh.bake, scene, **keywords)
                self.assertEqual(e.where, where)
                self.assertIn(said, str(e))
                self.assertNotIn("--", str(e))
        for keywords in (dict(spp=0), dict(face=0), dict(directions=1, operator="surfel"), dict(max_depth=-1),
                         dict(records=-1), dict(neighbors=-2), dict(threshold=float("nan")), dict(max_memory=-1.0)):
            with self.subTest(**keywords):
                error_of(self, ssphh.bake, scene, **keywords)
        self.assertRaises(TypeError, ssphh.bake, scene, spp="many")
        self.assertRaises(TypeError, ssphh.bake, "builtin:box")


if __name__ == "__main__":
    unittest.main()
