"""test_summary.py CTEST.xml FOLDER: what was skipped, by reason, then one line of counts, of every test: those of GoogleTest's
programs, whose own files lie in FOLDER, and what else ctest's JUnit file says."""

import collections
import pathlib
import sys
import xml.etree.ElementTree


def read(path):
    return list(xml.etree.ElementTree.parse(path).getroot().iter("testcase"))


def main(path, folder):
    if not path.exists():
        return  # ctest was asked to run nothing
    skipped = collections.defaultdict(list)
    passed = failed = 0
    suites = {file.name.removesuffix(".xml"): file for file in folder.glob("*.xml")}
    for entry in read(path):
        name = entry.get("name")
        inside = read(suites[name.replace("/", "-")]) if name.replace("/", "-") in suites else []
        for case in inside:
            if case.find("failure") is not None:
                failed += 1
            elif case.find("skipped") is not None:
                why = case.find("skipped").get("message").split("\n", 1)[-1].strip()
                skipped[why or "no reason given"].append(case.get("classname") + "." + case.get("name"))
            elif case.get("status") == "notrun":
                skipped["disabled"].append(case.get("classname") + "." + case.get("name"))
            else:
                passed += 1
        if entry.get("status") in ("notrun", "disabled"):
            skipped["no reason given"].append(name)
        elif entry.get("status") == "fail":
            # Also a program that ended before it said what its tests did, or after all had passed.
            failed += not any(case.find("failure") is not None for case in inside)
        elif not inside:
            passed += 1
    count = sum(map(len, skipped.values()))
    print("\nskipped: " + (str(count) if count else "none"))
    for why, names in sorted(skipped.items()):
        print(f"  {why}\n    {', '.join(names)}")
    print(f"\n{passed} passed, {failed} failed, {count} skipped")


main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
