"""Looked-up light against what is known of it: constant radiance gives pi times as much irradiance."""

import unittest

import numpy as np

import ssphh
from support import constant, error_of


class Lookups(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = ssphh.load("builtin:box")
        cls.points, cls.normals, _ = cls.scene.surface_points(200, seed=3)
        places = [[x, y, z] for x in (-0.3, 0.3) for y in (-0.3, 0.3) for z in (-0.3, 0.3)]
        cls.a, cls.b = np.array([0.5, 1, 2]), np.array([3, 0.25, 0])
        light = np.array([[constant(cls.a)] * 8, [constant(cls.b)] * 8])
        cls.probes = ssphh.ProbeSet.from_arrays(places, light, light_groups=["a", "b"])

    def lookup(self, **keywords):
        with self.assertLogs("ssphh", "WARNING"):
            return ssphh.Lookup(self.scene, self.probes, force=True, **keywords)

    def test_constant_light(self):
        expected = np.broadcast_to(np.pi * (self.a + self.b), self.points.shape)
        for weights in ("mls", "trilinear", "distance", None):
            found = self.lookup(weights=weights).irradiance(self.points, self.normals)
            self.assertEqual(found.dtype, np.float32)
            np.testing.assert_allclose(found, expected, rtol=1e-4, err_msg=str(weights))

    def test_each_group_alone(self):
        found = self.lookup().irradiance_by_group(self.points, self.normals)
        self.assertEqual(list(found), ["a", "b"])
        np.testing.assert_allclose(found["a"], np.broadcast_to(np.pi * self.a, self.points.shape), rtol=1e-4)
        np.testing.assert_allclose(found["b"], np.broadcast_to(np.pi * self.b, self.points.shape), rtol=1e-4)

    def test_takes_any_numbers_and_any_order_of_memory(self):
        lookup = self.lookup()
        found = lookup.irradiance(self.points, self.normals)
        for same in (np.asfortranarray(self.points), self.points.astype(np.float64), self.points.tolist()):
            np.testing.assert_array_equal(lookup.irradiance(same, self.normals), found)
        np.testing.assert_array_equal(lookup.irradiance(self.points[::2], self.normals[::2]), found[::2])
        np.testing.assert_allclose(lookup.irradiance(self.points, 7 * self.normals), found, rtol=1e-5)
        np.testing.assert_array_equal(lookup.irradiance(self.points, self.normals, np.zeros(200, bool)), found)

    def test_agrees_with_path_tracing(self):
        scene = ssphh.load("builtin:cornell")
        points, normals, moves = scene.surface_points(100, seed=5)
        probes = ssphh.bake(scene, operator="surfel", viz="off", records=2048)
        looked_up = ssphh.Lookup(scene, probes).irradiance(points, normals, moves)
        direct, indirect = ssphh.trace_irradiance(scene, points, normals, spp=256)
        self.assertGreater(float(direct.max()), 0)
        # `measure` of this bake tells of 6 % mean relative error; means over all points are far nearer.
        np.testing.assert_allclose(looked_up.mean(axis=0), indirect.mean(axis=0), rtol=0.05)
        same = ssphh.trace_irradiance(scene, points, normals, spp=256)
        np.testing.assert_array_equal(same[1], indirect)

    def test_refuses_what_is_no_surface(self):
        look = self.lookup().irradiance
        for points, normals, moves, where in (
            (self.points[:, :2], self.normals, None, "points"),
            (self.points, self.normals[:5], None, "normals"),
            (self.points, 0 * self.normals, None, "normals"),
            (self.points * np.nan, self.normals, None, "points"),
            (self.points, self.normals, [True], "moves"),
            (None, self.normals, None, "points"),
        ):
            self.assertEqual(error_of(self, look, points, normals, moves).where, where)
        for keywords, where in ((dict(weights="best"), "weights"), (dict(lookup="dark"), "lookup"), (dict(light="own"), "light")):
            self.assertEqual(error_of(self, ssphh.Lookup, self.scene, self.probes, force=True, **keywords).where, where)
        self.assertIn("fitted", str(error_of(self, ssphh.Lookup, self.scene, self.probes, weights="fitted", force=True)))
        self.assertIn("another scene", error_of(self, ssphh.Lookup, self.scene, self.probes).problem)


if __name__ == "__main__":
    unittest.main()
