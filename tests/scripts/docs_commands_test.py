#!/usr/bin/env python3
"""Every command line of the tool in a page of the project names commands and options that there are, and those for beginners run:
docs_commands_test.py TOOL."""

import functools
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

root = pathlib.Path(__file__).resolve().parent.parent.parent
tool = pathlib.Path(sys.argv.pop(1)).resolve()

FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.S | re.M)
# In a block: at the line's begin, perhaps behind a prompt, variables and a folder.
IN_BLOCK = re.compile(r"^\s*(?:\$ )?(?:\w+=\S+ )*(?:\S*/)?ssphh ((?:[a-z]|--).*)")
# In running text: `ssphh ...`, in one line.
IN_TEXT = re.compile(r"(?<!`)`(?:\S*/)?ssphh ([a-z][^`\n]*)`")
OPTION = re.compile(r"(?<![\w-])(--[a-z][a-z0-9-]*|-[a-z])(?![\w-])")


def pages():
    names = subprocess.run(["git", "ls-files", "*.md"], cwd=root, capture_output=True, text=True).stdout.split()
    found = [root / name for name in names] or [*root.glob("*.md"), *root.glob("docs/**/*.md"), *root.glob("libs/**/*.md")]
    return [page for page in found if page.name != "CHANGELOG.md" and page.exists()]


def joined(block):
    """Lines of a block; those that end in a backslash, or go on with an indented option, are one."""
    return re.sub(r"\n[ \t]+(?=\[?-)", " ", block.replace("\\\n", " ")).splitlines()


def command_lines(text):
    for _, block in FENCE.findall(text):
        for line in joined(block):
            if match := IN_BLOCK.match(line):
                yield re.split(r"\s#\s", match[1])[0]
    for match in IN_TEXT.finditer(FENCE.sub("", text)):
        yield match[1]


@functools.lru_cache(maxsize=None)
def help_of(command):
    """What --help says; None where there is no such command."""
    done = subprocess.run([tool, *command, "--help"], capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else None


@functools.lru_cache(maxsize=None)
def children(command):
    """Names of the commands of a group."""
    text = help_of(command)
    if "Subcommands:" not in text:
        return frozenset()
    return frozenset(re.findall(r"^  ([a-z][a-z-]*)\s", text.split("Subcommands:")[1], re.M))


def alternatives(word):
    """`eval|project|rotate` names several."""
    return re.findall(r"[a-z][a-z-]*", word) if re.fullmatch(r"[a-z|-]+", word) else []


def problems(line):
    words, commands = line.split(), [()]
    while words and (below := set().union(*(children(c) for c in commands))):
        names = alternatives(words[0])
        if not names:
            break
        if unknown := [name for name in names if name not in below]:
            return [f"there is no command {' '.join((*commands[0], unknown[0]))}"]
        commands = [(*c, name) for c in commands for name in names if name in children(c)]
        words.pop(0)
    known = set().union(*(OPTION.findall(help_of(c)) for c in commands))
    rest = re.sub(r"'[^']*'|\"[^\"]*\"", "", " ".join(words))
    return [f"{' '.join(commands[0])} has no option {option}" for option in OPTION.findall(rest) if option not in known]


class Commands(unittest.TestCase):
    def test_pages_name_commands_and_options_that_there_are(self):
        count = 0
        for page in pages():
            for line in command_lines(page.read_text()):
                count += 1
                for problem in problems(line):
                    with self.subTest(page=str(page.relative_to(root)), line=line):
                        self.fail(problem)
        self.assertGreater(count, 150)

    def test_roles_run_as_they_stand(self):
        """The cheap lines: those of docs/start.md that are for roles, one after the other."""
        part = (root / "docs/start.md").read_text().split("\n## By role\n")[1].split("\n## ")[0]
        lines = [line for line in command_lines(part)]
        self.assertEqual(len(lines), 16)
        with tempfile.TemporaryDirectory() as folder:
            for line in lines:
                words = shlex.split(line) + ["--progress", "none", "--config", "none"]
                done = subprocess.run([tool, *words], cwd=folder, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, f"{line}\n{done.stderr}")
            made = {path.name for path in pathlib.Path(folder).iterdir()}
            self.assertLessEqual({"rooms.sphl", "small.sphl", "rooms.sphlc", "mine.png", "difference.png", "cornell.sphl"}, made)

    def test_what_is_wrong_is_found(self):
        self.assertEqual(problems("render builtin:cornell --spp 4 -o a.exr"), [])
        self.assertEqual(problems("render builtin:cornell --sppp 4"), ["render has no option --sppp"])
        self.assertEqual(problems("rander builtin:cornell"), ["there is no command rander"])
        self.assertEqual(problems("probe convrt a.sphl"), ["there is no command probe convrt"])
        self.assertEqual(problems("probe info|lint FILE --clearance M"), [])
        self.assertEqual(list(command_lines("```\n$ A=1 bin/ssphh bake x \\\n    --fit   # not --this\n```\nand `ssphh hier f`")), ["bake x      --fit  ", "hier f"])


if __name__ == "__main__":
    unittest.main()
