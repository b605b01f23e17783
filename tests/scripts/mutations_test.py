"""What scripts/mutate puts into a source file."""

import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import mutations  # noqa: E402

SAMPLE = '''#include <vector>  // a < b
/* 0.5f + 1 */
std::vector<float> weights(const vec3& p, float t) {
  const char* text = "x == 7";
  std::vector<float> out(count(p, t), 0.25f);
  out.reserve(17);
  for (int i = 0; i < n; ++i) {
    if (!seen(i) && i >= 12) continue;
    out[i] += -scale * p.x / t;
  }
  finish(out,
         {p.x, t});
  return out;
}
'''


def changes(kind):
    """(before, after) of every fault of a kind in the sample."""
    return [(SAMPLE[m.begin:m.end], m.after) for m in mutations.candidates(SAMPLE)[kind]]


class Mutations(unittest.TestCase):
    def test_comparisons_are_turned_both_ways_and_negations_dropped(self):
        self.assertCountEqual(changes("comparison"), [("<", "<="), ("<", ">"), ("&&", "||"), (">=", ">"), (">=", "<="), ("!", "")])

    def test_signs_and_operators(self):
        self.assertCountEqual(changes("sign"), [("+=", "-="), ("-", ""), ("*", "/"), ("/", "*")])

    def test_constants_change_by_2_to_50_percent(self):
        found = changes("constant")
        self.assertCountEqual([before for before, _ in found], ["0.25f", "12"])
        for before, after in found:
            ratio = float(after.rstrip("f")) / float(before.rstrip("f"))
            self.assertTrue(0.02 <= abs(ratio - 1) <= 0.51, (before, after))
            self.assertEqual(before.endswith("f"), after.endswith("f"))

    def test_whole_statements_are_dropped_but_no_declaration_or_return(self):
        self.assertCountEqual([before.split("(")[0].split(" ")[0] for before, _ in changes("dropped statement")],
                              ["if", "out[i]", "finish"])

    def test_arguments_of_calls_and_lists_but_no_parameters(self):
        self.assertCountEqual(changes("swapped arguments"),
                              [("p, t", "t, p"), ("count(p, t), 0.25f", "0.25f, count(p, t)"), ("p.x, t", "t, p.x")])
        self.assertCountEqual([before for before, _ in changes("dropped argument")], [", t", ", 0.25f", ", t"])

    def test_arguments_whose_order_is_all_the_same_are_not_swapped(self):
        text = "float f() {\n  return glm::dot(a, b) * std::min(c, d) * glm::length(glm::cross(g, h)) + pow(e, f);\n}\n"
        swapped = mutations.candidates(text)["swapped arguments"]
        self.assertEqual([text[m.begin:m.end] for m in swapped], ["e, f"])

    def test_bounds_indices_and_small_numbers_are_off_by_one(self):
        self.assertCountEqual(changes("off by one"), [("n", "n - 1"), ("n", "n + 1"), ("i", "i + 1"), ("0", "1")])

    def test_no_fault_moves_a_line_or_lies_outside_code(self):
        for path in [*ROOT.glob("libs/trace/src/*.*"), *ROOT.glob("libs/realtime/shaders/*")]:
            text = path.read_text()
            code = mutations.code_only(text)
            self.assertEqual(len(code), len(text), path)
            for faults in mutations.candidates(text).values():
                for fault in faults:
                    self.assertEqual(fault.apply(text).count("\n"), text.count("\n"), (path, fault))
                    self.assertNotEqual(fault.apply(text), text, (path, fault))
                    if fault.kind not in ("dropped statement", "dropped argument", "swapped arguments"):
                        self.assertEqual(code[fault.begin:fault.end], text[fault.begin:fault.end], (path, fault))


if __name__ == "__main__":
    unittest.main()
