"""Spherical harmonics against integrals done here, by Gauss-Legendre in z times even steps in azimuth."""

import unittest

import numpy as np

from ssphh import sh
from support import error_of


def sphere(n=24):
    z, wz = np.polynomial.legendre.leggauss(n)
    phi = 2 * np.pi * np.arange(2 * n) / (2 * n)
    z, phi = [a.ravel() for a in np.meshgrid(z, phi, indexing="ij")]
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=1), np.repeat(wz, 2 * n) * np.pi / n


def turned(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


class SphericalHarmonics(unittest.TestCase):
    def setUp(self):
        self.directions, self.weights = sphere()
        self.coefficients = np.random.default_rng(1).normal(size=(25, 3)).astype(np.float32)

    def test_basis_is_orthonormal_and_as_the_conventions_say(self):
        y = sh.basis(sh.max_degree, self.directions).astype(float)
        self.assertEqual(y.shape[1], sh.coefficient_count(sh.max_degree))
        np.testing.assert_allclose(y.T @ (y * self.weights[:, None]), np.eye(121), atol=1e-5)
        np.testing.assert_allclose(y[:, 1:4], 0.48860251 * self.directions[:, [1, 2, 0]], atol=1e-6)

    def test_projection_finds_what_was_evaluated(self):
        values = sh.evaluate(self.coefficients, self.directions)
        np.testing.assert_allclose(values, sh.basis(4, self.directions) @ self.coefficients, atol=1e-4)
        np.testing.assert_allclose(sh.project(4, self.directions, self.weights, values), self.coefficients, atol=1e-4)

    def test_a_cube_of_one_colour_is_constant(self):
        faces = np.broadcast_to([1, 2, 3], (6, 8, 8, 3))
        found = sh.project_cube(2, faces)
        np.testing.assert_allclose(found[0], np.sqrt(4 * np.pi) * np.array([1, 2, 3]), rtol=1e-5)
        np.testing.assert_allclose(found[1:], 0, atol=1e-5)
        lit = np.zeros((6, 8, 8, 3))
        lit[2] = 1  # +Y
        found = sh.project_cube(1, lit)
        self.assertGreater(found[1, 0], 0.5)
        np.testing.assert_allclose(found[2:], 0, atol=1e-5)

    def test_irradiance_is_the_cosine_integral(self):
        normal = np.array([0.48, 0.6, 0.64])
        d, w = sphere(200)  # the clamp has a kink, so many
        light = sh.evaluate(self.coefficients, d).astype(float)
        expected = (light * (w * np.maximum(d @ normal, 0))[:, None]).sum(axis=0)
        np.testing.assert_allclose(sh.evaluate(sh.irradiance(self.coefficients), [normal])[0], expected, rtol=2e-3)

    def test_rotation_carries_the_function_along(self):
        r = turned(0.7)
        before = sh.evaluate(self.coefficients, self.directions)
        after = sh.evaluate(sh.rotate(self.coefficients, r), (self.directions @ r.T).astype(np.float32))
        np.testing.assert_allclose(after, before, atol=2e-4)
        for wrong in (2 * r, np.zeros((3, 3)), np.eye(2)):
            self.assertEqual(error_of(self, sh.rotate, self.coefficients, wrong).where, "matrix")

    def test_windows_damp_bands(self):
        l = np.repeat(range(5), [1, 3, 5, 7, 9])
        np.testing.assert_allclose(sh.window(self.coefficients, "hanning", width=5),
                                   self.coefficients * ((1 + np.cos(np.pi * l / 5)) / 2)[:, None], rtol=1e-5, atol=1e-6)
        np.testing.assert_allclose(sh.window(self.coefficients, "lanczos", width=5),
                                   self.coefficients * np.sinc(l / 5)[:, None], rtol=1e-5, atol=1e-6)
        peak = sh.project(4, [[0, 0, 1]], [1.0], [[1, 1, 1]])
        self.assertLess(sh.minimum(sh.irradiance(peak)).min(), 0)
        self.assertGreater(sh.minimum(sh.irradiance(sh.window(peak))).min(), -1e-4)
        self.assertEqual(error_of(self, sh.window, peak, "hanning").where, "width")
        self.assertEqual(error_of(self, sh.window, peak, "square").where, "window")

    def test_minimum_is_the_lowest_value(self):
        lowest = sh.minimum(self.coefficients)
        seen = sh.evaluate(self.coefficients, sphere(100)[0]).min(axis=0)
        self.assertTrue(np.all(lowest <= seen + 1e-4))
        np.testing.assert_allclose(lowest, seen, atol=0.02)

    def test_conventions_there_and_back(self):
        for convention in ("d3dx", "unity", "three", "filament"):
            there = sh.convert(self.coefficients[:9], convention)
            np.testing.assert_allclose(sh.convert(there, "ssphh", from_convention=convention), self.coefficients[:9], rtol=1e-5)
        np.testing.assert_allclose(sh.convert(self.coefficients[:4], "d3dx")[[1, 3]], -self.coefficients[[1, 3]])
        self.assertEqual(error_of(self, sh.convert, self.coefficients, "maya").where, "to")

    def test_refuses_other_shapes(self):
        for function, arguments, where in (
            (sh.evaluate, (self.coefficients[:7], self.directions), "coefficients"),
            (sh.evaluate, (self.coefficients[:, :2], self.directions), "coefficients"),
            (sh.evaluate, (self.coefficients, 2 * self.directions), "directions"),
            (sh.basis, (11, self.directions), "degree"),
            (sh.basis, (-1, self.directions), "degree"),
            (sh.project, (2, self.directions, self.weights[:3], self.directions), "weights"),
            (sh.project_cube, (2, np.zeros((6, 4, 5, 3))), "faces"),
            (sh.project_cube, (2, np.zeros((5, 4, 4, 3))), "faces"),
            (sh.irradiance, ("light",), "coefficients"),
        ):
            self.assertEqual(error_of(self, function, *arguments).where, where)


if __name__ == "__main__":
    unittest.main()
