"""Command lines of the tool in pages: where they stand, and what of them a parser can read."""

import re
import subprocess

FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.S | re.M)
# In a block: at the line's begin, perhaps behind a prompt (`alice$`), variables and a folder.
IN_BLOCK = re.compile(r"^\s*(?:\w*\$ +)?(?:\w+=\S+ )*(?:\S*/)?ssphh ((?:[a-z]|--).*)")
# In running text: `ssphh ...`, in one line.
IN_TEXT = re.compile(r"(?<!`)`(?:\S*/)?ssphh ([a-z][^`\n]*)`")
OPTION = re.compile(r"--[a-z][a-z0-9-]*|-[a-z]")
# Stands for something else: SCENE, NAME=VALUE, T, …
PLACEHOLDER = re.compile(r"\b[A-Z]{2,}\b(?!-\d)|\b[A-Z]\b|…|\.\.\.(?!/)")


def pages(root):
    names = subprocess.run(["git", "ls-files", "*.md"], cwd=root, capture_output=True, text=True).stdout.split()
    found = [root / name for name in names] or [*root.glob("*.md"), *root.glob("docs/**/*.md"), *root.glob("libs/**/*.md")]
    return [page for page in found if page.name != "CHANGELOG.md" and page.exists()]


def joined(block):
    """Lines of a block; those that end in a backslash, or go on with an indented option, are one."""
    return re.sub(r"\n[ \t]+(?=\[?-)", " ", block.replace("\\\n", " ")).splitlines()


def command_lines(text):
    """Each with whether it stands in a block."""
    for _, block in FENCE.findall(text):
        for line in joined(block):
            if match := IN_BLOCK.match(line):
                yield re.split(r"\s#\s", match[1])[0], True
    for match in IN_TEXT.finditer(FENCE.sub("", text)):
        yield match[1], False


def is_concrete(line):
    """Whether it could be typed as it stands."""
    return not PLACEHOLDER.search(line) and not re.search(r"[\[\]|]|(?<!\S)\S*\?\S*\.", line)


def alternatives(word):
    return [part for part in word.split("|") if part] or [word]


def readings(line):
    """Of a line with placeholders and alternatives: lines of words, each a command with one option and what stands behind it."""
    words = re.sub(r"[\[\]…]", " ", line).split()
    commands = [[]]
    while words and re.fullmatch(r"[a-z][a-z-]*(\|[a-z][a-z-]*)*", words[0]) and len(commands[0]) < (2 if commands[0] in GROUPS else 1):
        commands = [[*command, name] for command in commands for name in words.pop(0).split("|")]
    for command in commands:
        if command not in GROUPS:
            yield command
    for at, word in enumerate(words):
        if not OPTION.fullmatch(word):
            continue
        behind = []
        for value in words[at + 1:]:
            if OPTION.fullmatch(value) or value == "|":
                break
            behind.append(value)
        if any(PLACEHOLDER.search(value) for value in behind):
            behind = []
        for command in commands:
            for first in alternatives(behind[0]) if behind else [None]:
                yield [*command, word, *([first] if first else []), *behind[1:]]


GROUPS = [["probe"], ["sh"], ["farm"], ["scene"], ["sphl"], ["cubemap"]]
