#!/usr/bin/env python3
"""Every command line of the tool in a page of the project is one that the tool's own parser takes, and all of a block run where a machine
without a farm, a window and Blender can: docs_commands_test.py TOOL PARSE_LINES [--list]. The last tells what is not run, and why."""

import pathlib
import shlex
import subprocess
import sys
import tempfile
import unittest

from docs_command_lines import command_lines, is_concrete, pages, readings
from docs_command_runs import Runs, why_not

root = pathlib.Path(__file__).resolve().parent.parent.parent
LIST = "--list" in sys.argv and not sys.argv.remove("--list")
parser = subprocess.Popen([sys.argv.pop(2)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
tool = pathlib.Path(sys.argv.pop(1)).resolve()


def parsed(words):
    """The kind of mistake that the parser finds, "ok" where there is none, and what it says."""
    parser.stdin.write("\t".join(words) + "\n")
    parser.stdin.flush()
    kind, _, message = parser.stdout.readline().rstrip("\n").partition("\t")
    return kind, message


def for_roles():
    """A part of docs/start.md."""
    return (root / "docs/start.md").read_text().split("\n## By role\n")[1].split("\n## ")[0]


def problem(line, in_block=True):
    """What is wrong with a documented line, or None."""
    for words in readings(line):  # option by option
        kind, message = parsed(["part", *words])
        if kind in ("ValidationError", "ConversionError", "ExtrasError"):
            return message
    if not is_concrete(line):
        return None
    kind, message = parsed(shlex.split(line))
    missing = kind in ("RequiredError", "ArgumentMismatch") and not in_block  # `bake --update` in a sentence
    return message if kind not in ("ok", "CallForHelp") and not missing and "does not exist" not in message else None


class Commands(unittest.TestCase):
    def test_the_parser_takes_every_line(self):
        count = 0
        for page in pages(root):
            for line, in_block in command_lines(page.read_text()):
                count += 1
                with self.subTest(page=str(page.relative_to(root)), line=line):
                    self.assertIsNone(problem(line, in_block))
        self.assertGreater(count, 250)

    def test_blocks_run(self):
        """Page by page, one line after the other, with sizes and counts turned down."""
        count, left_out = 0, []
        with tempfile.TemporaryDirectory() as folder:
            runs = Runs(tool, root, pathlib.Path(folder))
            for page in pages(root):
                name = str(page.relative_to(root))
                for line, in_block in command_lines(page.read_text().replace(for_roles(), "")):
                    if not in_block:
                        continue
                    if reason := why_not(line):
                        left_out.append(f"{name}: {line.strip()}: {reason}")
                        continue
                    count += 1
                    with self.subTest(page=name, line=line):
                        code, told = runs.run(name, line)
                        self.assertEqual(code, 0, told)
        if LIST:
            print(f"{count} run; not run:", *left_out, sep="\n")
        self.assertGreater(count, 60)

    def test_roles_run_as_they_stand(self):
        """Those of docs/start.md that are for roles, with nothing turned down."""
        lines = [line for line, _ in command_lines(for_roles())]
        self.assertEqual(len(lines), 16)
        with tempfile.TemporaryDirectory() as folder:
            for line in lines:
                words = shlex.split(line) + ["--progress", "none", "--config", "none"]
                done = subprocess.run([tool, *words], cwd=folder, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, f"{line}\n{done.stderr}")
            made = {path.name for path in pathlib.Path(folder).iterdir()}
            self.assertLessEqual({"rooms.sphl", "small.sphl", "rooms.sphlc", "mine.png", "difference.png", "cornell.sphl"}, made)

    def test_what_is_wrong_is_found(self):
        for right in ["render builtin:cornell --spp 4 -o a.exr", "probe info|lint FILE", "bake SCENE [--quality draft|good] …", "sh eval|plot …"]:
            self.assertIsNone(problem(right), right)
        self.assertIsNone(problem("bake --update", in_block=False))
        for wrong, told in [("render builtin:cornell --sppp 4", "--sppp"), ("rander builtin:cornell", "rander"), ("probe convrt a.sphl", "convrt"),
                            ("render builtin:cornell --spp 4", "--output is required"), ("render builtin:cornell -o a.exr --spp 0", "not in range"),
                            ("bake SCENE [--quality draft|better] …", "better"), ("sh eval|plt …", "plt"), ("probe info FILE --sppp N", "--sppp"),
                            ("compare REF TEST --map absolute|sined", "sined"), ("render SCENE [--aov direct,indirekt]", "indirekt")]:
            self.assertIn(told, problem(wrong) or "nothing", wrong)
        self.assertEqual(list(command_lines("```\n$ A=1 bin/ssphh bake x \\\n    --fit   # not --this\n```\nand `ssphh hier f`")),
                         [("bake x      --fit  ", True), ("hier f", False)])


if __name__ == "__main__":
    unittest.main()
