"""scripts/figures at its quick size: panels, self-contained pages, command lines, and what cannot be made is named."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import figure_list  # noqa: E402
from png_sheet import read_png  # noqa: E402

TOOL = sys.argv.pop(1)


def figures(folder, *words):
    return subprocess.run([ROOT / "scripts/figures", *words, "--quick", "--tool", TOOL, "-o", folder], capture_output=True, text=True)


class Figures(unittest.TestCase):
    def test_every_figure_of_the_paper_is_listed(self):
        self.assertEqual(list(figure_list.FIGURES), [*(str(i) for i in range(1, 16)), "table1"])

    def test_pages_need_nothing_else_and_command_lines_are_those_that_ran(self):
        with tempfile.TemporaryDirectory() as folder:
            run = figures(folder, "3", "11", "15")
            self.assertEqual(run.returncode, 0, run.stderr)
            for name, panels, commands in (("3", 2, 4), ("11", 4, 4), ("15", 12, 36)):
                here = pathlib.Path(folder) / name
                page = (here / "index.html").read_text()
                self.assertEqual(page.count('src="data:image/png;base64,'), panels, name)
                self.assertEqual(re.findall(r'(?:src|href)="(?!data:)|url\(|<script|https?:', page), [], name)
                lines = (here / "commands.txt").read_text().splitlines()
                self.assertEqual(len(lines), commands, name)
                self.assertTrue(all(line.startswith("ssphh ") for line in lines), name)

    def test_depth_0_of_figure_14_shows_lamps_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(figures(folder, "14").returncode, 0)
            means = [self.mean(pathlib.Path(folder) / f"14/probe-{depth}-many.png") for depth in (0, 1, 3, 25)]
            self.assertEqual(sorted(means), means)
            self.assertLess(means[0], 0.5 * means[3])
            difference = self.mean(pathlib.Path(folder) / "14/difference-0.png")
            self.assertLess(difference, self.mean(pathlib.Path(folder) / "14/difference-3.png"))

    def mean(self, picture):
        width, height, rows = read_png(picture)
        self.assertEqual((width, height), (48, 8))
        return sum(map(sum, rows)) / (3 * width * height)

    def test_what_cannot_be_made_is_named_with_the_reason(self):
        with tempfile.TemporaryDirectory() as folder:
            run = figures(folder, "8")
            self.assertEqual(run.returncode, 1)
            self.assertIn("8: not made: needs `ssphh probe preview --edges`", run.stderr)
            self.assertFalse((pathlib.Path(folder) / "8").exists())

    def test_unknown_names_are_refused(self):
        run = figures("/nowhere", "16")
        self.assertEqual(run.returncode, 1)
        self.assertIn("16: no such figure", run.stderr)


if __name__ == "__main__":
    unittest.main()
