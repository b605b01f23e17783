"""scripts/figures at its quick size: panels, self-contained pages, command lines, what is drawn over pictures, and messages."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import figure_list  # noqa: E402

TOOL = sys.argv.pop(1)


def figures(folder, *words):
    return subprocess.run([ROOT / "scripts/figures", *words, "--quick", "--tool", TOOL, "-o", folder], capture_output=True, text=True)


class Figures(unittest.TestCase):
    def test_every_figure_of_the_paper_is_listed(self):
        self.assertEqual(list(figure_list.FIGURES), [*(str(i) for i in range(1, 16)), "table1"])

    def test_pages_need_nothing_else_and_command_lines_are_those_that_ran(self):
        with tempfile.TemporaryDirectory() as folder:
            run = figures(folder, "3", "11", "12", "15")
            self.assertEqual(run.returncode, 0, run.stderr)
            for name, panels, commands in (("3", 2, 4), ("11", 4, 4), ("12", 6, 6), ("15", 12, 36)):
                here = pathlib.Path(folder) / name
                page = (here / "index.html").read_text()
                self.assertEqual(page.count('src="data:image/png;base64,'), panels, name)
                self.assertEqual(re.findall(r'(?:src|href)="(?!data:)|url\(|<script|https?:', page), [], name)
                lines = (here / "commands.txt").read_text().splitlines()
                self.assertEqual(len(lines), commands, name)
                self.assertTrue(all(line.startswith("ssphh ") for line in lines), name)

    def test_a_reference_of_two_figures_is_made_once(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(figures(folder, "1", "11").returncode, 0)
            first, second = pathlib.Path(folder) / "1/truth.exr", pathlib.Path(folder) / "11/gallery2.exr"
            self.assertEqual(first.read_bytes(), second.read_bytes())
            self.assertIn("-o gallery2.exr", (pathlib.Path(folder) / "11/commands.txt").read_text())

    def test_depth_0_of_figure_14_shows_lamps_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(figures(folder, "14").returncode, 0)
            means = [self.mean(pathlib.Path(folder) / f"14/probe-{depth}-many.png") for depth in (0, 1, 3, 25)]
            self.assertEqual(sorted(means), means)
            self.assertLess(means[0], 0.5 * means[3])
            difference = self.mean(pathlib.Path(folder) / "14/difference-0.png")
            self.assertLess(difference, self.mean(pathlib.Path(folder) / "14/difference-3.png"))

    def mean(self, picture):
        pixels = Image.open(picture).convert("RGB")
        self.assertEqual(pixels.size, (48, 8))
        return sum(pixels.tobytes()) / (3 * 48 * 8)

    def test_overlays_cover_pictures_and_messages_are_shown(self):
        with tempfile.TemporaryDirectory() as folder:
            run = figures(folder, "2", "4", "5", "6", "7", "8", "9", "10")
            self.assertEqual(run.returncode, 0, run.stderr)
            here = pathlib.Path(folder)
            for drawn, plain in (("4/tetrahedra", "4/volume"), ("4/transfer", "4/prt"), ("5/all", "5/vpl"), ("6/bounced", "6/vct"),
                                 ("7/edges", "7/light"), ("7/surfels", "7/ssphh"), ("7/links", "7/ssphh")):
                differ = self.differing(here / f"{drawn}.png", here / f"{plain}.png")
                self.assertGreater(differ, 0.002, drawn)
            self.assertGreater(self.differing(here / "9/gallery1-all.png", here / "9/gallery1-two.png"), 0.002)
            page = (here / "10/index.html").read_text()
            for words in ("0001.job.json", "0001.result.json", "&quot;format&quot;:&quot;ssphh-result&quot;"):
                self.assertIn(words, page)

    def differing(self, one, other):
        """Share of the bytes of two pictures of one size."""
        a, b = Image.open(one).convert("RGB"), Image.open(other).convert("RGB")
        self.assertEqual(a.size, b.size)
        return sum(x != y for x, y in zip(a.tobytes(), b.tobytes())) / (3 * a.width * a.height)

    def test_unknown_names_are_refused(self):
        run = figures("/nowhere", "16")
        self.assertEqual(run.returncode, 1)
        self.assertIn("16: no such figure", run.stderr)


if __name__ == "__main__":
    unittest.main()
