"""Pictures have the pixels of the tool's, errors the numbers that it tells."""

import json
import unittest

import numpy as np

import ssphh
from support import InAFolder, error_of, run_tool

SIZE = dict(width=24, height=16, spp=2)
OPTIONS = ["--width", 24, "--height", 16, "--spp", 2]


class Pictures(InAFolder):
    def test_same_pixels_as_the_tool(self):
        scene = ssphh.load("builtin:cornell")
        probes = ssphh.bake(scene, self.path("a.sphl"), spp=1, face=4, degree=2)
        for method, keywords, options in (
            ("path", dict(max_depth=3, passes=2), ["--max-depth", 3, "--passes", 2]),
            ("ssphh", dict(probes=probes, lookup="light"), ["--probes", self.path("a.sphl"), "--lookup", "light"]),
            ("ssphh", dict(probes=probes), ["--probes", self.path("a.sphl")]),
            ("vpl", dict(param={"photons": 100}), ["--param", "photons=100"]),
            ("ambient", {}, []),
        ):
            with self.subTest(method=method):
                run_tool("render", "builtin:cornell", "-o", self.path("tool.exr"), "--method", method, *OPTIONS, *options)
                picture = ssphh.render(scene, method, **SIZE, **keywords)
                self.assertEqual(picture.dtype, np.float32)
                np.testing.assert_array_equal(picture, ssphh.read_image(self.path("tool.exr")))

    def test_layers_add_up(self):
        scene = ssphh.load("builtin:cornell")
        layers = ssphh.render_layers(scene, **SIZE)
        self.assertEqual(list(layers)[:6], ["color", "direct", "indirect", "albedo", "normal", "depth"])
        np.testing.assert_allclose(layers["direct"] + layers["indirect"], layers["color"], rtol=1e-5, atol=1e-6)
        groups = [layers["group " + name] for name in scene.light_groups]
        np.testing.assert_array_equal(np.sum(groups, axis=0), layers["color"])
        np.testing.assert_array_equal(ssphh.render(scene, **SIZE), layers["color"])
        self.assertEqual(layers["depth"].shape, (16, 24))

    def test_whole_spheres_are_drawn_around_a_place(self):
        scene = ssphh.load("builtin:box")
        strip = ssphh.render(scene, projection="cube", at=[0, 0, 0], width=48, height=8, spp=64)
        self.assertEqual(strip.shape, (8, 48, 3))
        self.assertEqual(error_of(self, ssphh.render, scene, at=[0, 0, 0]).where, "at")

    def test_refuses_what_is_no_picture(self):
        scene = ssphh.load("builtin:box")
        probes = ssphh.ProbeSet.from_arrays([[0, 0, 0]], np.ones((1, 1, 3)))
        for keywords, where in (
            (dict(width=0), "width and height"), (dict(height=1 << 20), "width and height"), (dict(spp=0), "spp and passes"),
            (dict(projection="flat"), "projection"), (dict(camera="nobody"), None), (dict(method="magic"), None),
            (dict(method="path", param={"a": 1}), "param"), (dict(method="path", probes=probes), "probes"),
            (dict(method="vpl", param={"photons": -1}), None), (dict(method="ssphh", probes=probes), "probes"),
        ):
            with self.subTest(**keywords):
                e = error_of(self, ssphh.render, scene, **keywords)
                if where:
                    self.assertEqual(e.where, where)

    def test_methods_tell_of_their_parameters(self):
        methods = ssphh.methods()
        self.assertIn("ground truth", methods["path"]["about"])
        parameters = methods["vpl"]["parameters"]
        self.assertLess(parameters["photons"]["least"], parameters["photons"]["default"])

    def test_files_keep_pixels(self):
        picture = np.random.default_rng(1).random((5, 7, 3), np.float32)
        ssphh.write_image(self.path("a.exr"), picture)
        np.testing.assert_array_equal(ssphh.read_image(self.path("a.exr")), picture)
        ssphh.write_image(self.path("a.png"), picture, exposure=0)
        shown = ssphh.tone_map(picture, exposure=0)
        self.assertEqual((shown.shape, shown.dtype), ((5, 7, 3), np.uint8))
        np.testing.assert_allclose(ssphh.read_image(self.path("a.png")), picture, atol=0.005)
        linear = np.where(shown <= 0.04045 * 255, shown / 255 / 12.92, ((shown / 255 + 0.055) / 1.055) ** 2.4)
        np.testing.assert_allclose(linear, picture, atol=0.005)
        np.testing.assert_array_equal(ssphh.tone_map(picture / 4, exposure=2), shown)
        grey = picture[:, :, 0]
        ssphh.write_image(self.path("grey.exr"), grey)
        np.testing.assert_array_equal(ssphh.read_image(self.path("grey.exr")), grey)
        for wrong in (np.zeros((2, 2, 2)), np.zeros(3), np.zeros((0, 3, 3)), "a.exr", np.array([["x"]])):
            self.assertEqual(error_of(self, ssphh.write_image, self.path("b.exr"), wrong).where, "picture")
        error_of(self, ssphh.write_image, self.path("b.txt"), picture)

    def test_compares_as_the_tool_does(self):
        random = np.random.default_rng(2)
        a, b = random.random((20, 30, 3), np.float32), random.random((20, 30, 3), np.float32)
        ssphh.write_image(self.path("a.exr"), a)
        ssphh.write_image(self.path("b.exr"), b)
        told = json.loads(run_tool("compare", self.path("a.exr"), self.path("b.exr"), "--json"))
        found = ssphh.compare(a, b)
        for key in ("mae", "rmse", "mse", "relmse", "mape", "smape", "bias", "max", "psnr", "ssim", "pixels"):
            self.assertEqual(found[key], told[key], key)
        self.assertEqual(found["flip"], told["flip"]["mean"])
        self.assertAlmostEqual(found["mae"], float(abs(b.astype(float) - a).mean()), places=12)
        self.assertAlmostEqual(float(ssphh.error_map(a, b, "flip").mean()), found["flip"], places=5)
        np.testing.assert_allclose(ssphh.error_map(a, b, "signed"), b - a, atol=1e-7)
        self.assertNotEqual(ssphh.compare(a, b, display=True)["flip"], found["flip"])
        half = np.zeros((20, 30))
        half[:, :15] = 1
        self.assertEqual(ssphh.compare(a, b, mask=half)["pixels"], 300)
        self.assertEqual(error_of(self, ssphh.compare, a, b[:5]).where, "test")
        self.assertEqual(error_of(self, ssphh.error_map, a, b, "heat").where, "map")


if __name__ == "__main__":
    unittest.main()
