"""test_summary.py RESULTS.xml: what ctest's JUnit file says was skipped, by reason, then one line of counts."""

import collections
import pathlib
import re
import sys
import xml.etree.ElementTree


def reason(case):
    """What GoogleTest printed below the line `FILE:LINE: Skipped`."""
    said = re.search(r": Skipped\n+(.+)", case.findtext("system-out") or "")
    return said[1].strip() if said else "no reason given"


def main(path):
    if not path.exists():
        return  # ctest was asked to run nothing
    cases = xml.etree.ElementTree.parse(path).getroot().findall("testcase")
    skipped = collections.defaultdict(list)
    for case in cases:
        if case.get("status") in ("notrun", "disabled") or case.find("skipped") is not None:
            skipped[reason(case)].append(case.get("name"))
    failed = sum(case.get("status") == "fail" for case in cases)
    count = sum(map(len, skipped.values()))
    print("\nskipped: " + (str(count) if count else "none"))
    for why, names in sorted(skipped.items()):
        print(f"  {why}\n    {', '.join(names)}")
    print(f"\n{len(cases) - failed - count} passed, {failed} failed, {count} skipped")


main(pathlib.Path(sys.argv[1]))
