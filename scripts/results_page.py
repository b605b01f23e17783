#!/usr/bin/env python3
"""Writes docs/results.md from the reports in out/ and the remarks in docs/results-notes.md: one section for each of its headings that
names a plan. Plans without a report keep the section that the page has."""

import pathlib
import re

root = pathlib.Path(__file__).resolve().parent.parent
page_file, notes_file = root / "docs/results.md", root / "docs/results-notes.md"


def sections(text):
    """{heading of level 2: what follows it}, and what comes before the first."""
    head, *parts = re.split(r"^## (.*)\n", text, flags=re.M)
    return head, dict(zip(parts[::2], parts[1::2]))


def of_plan(plan, remarks):
    """Title, what was run, tables and remarks; None without a report."""
    report = root / "out" / plan / "report.md"
    if not report.exists():
        return None
    head, parts = sections(report.read_text())
    commands = parts.pop("Commands", "")
    dates = sorted(re.findall(r"\d{4}-\d\d-\d\d(?=T\d\d:)", commands))
    title, about = head.split("\n\n")[0].removeprefix("# "), head.split("\n\n")[2]
    tables = "".join(f"#### {name}\n{text.rstrip()}\n\n" for name, text in parts.items())
    return f"### {title}\n\n{about.rstrip()} {dates[-1]}.\n\n{remarks.strip()}\n\n{tables}"


head, notes = sections(notes_file.read_text())
_, before = sections(page_file.read_text()) if page_file.exists() else ("", {})
page = head.split("\n\n", 1)[1].rstrip() + "\n\n"
for plan, remarks in notes.items():
    found = of_plan(plan, remarks)
    page += f"## {plan}\n\n{found}" if found else f"## {plan}\n{before.get(plan, '')}"
page_file.write_text("# Results\n\n" + page.rstrip() + "\n")
print(f"wrote {page_file.relative_to(root)}")
