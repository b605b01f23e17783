"""Small faults that can be put into C++ or GLSL: what scripts/mutate draws from.

`candidates(text)` lists them for a source file. They keep the number of lines, touch neither comments, literals of text
nor the preprocessor, and rely on the layout that scripts/check-format holds: spaces around binary operators, none
around the brackets of templates.
"""

import dataclasses
import random
import re

KINDS = ("comparison", "sign", "constant", "dropped statement", "dropped argument", "swapped arguments", "off by one")


@dataclasses.dataclass(frozen=True)
class Mutation:
    """The characters [begin, end) of a file become `after`."""

    kind: str
    begin: int
    end: int
    after: str

    def apply(self, text):
        return text[: self.begin] + self.after + text[self.end :]

    def line(self, text):
        return text.count("\n", 0, self.begin) + 1


_not_code = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:\\\n|[^\n])*',
    re.S | re.M)


def code_only(text):
    """`text` with everything that is no code replaced by spaces (literals by quotes), positions kept."""

    def blank(match):
        filler = '"' if match[0][0] in "\"'R" else " "
        return re.sub(r"[^\n]", filler, match[0])

    return _not_code.sub(blank, text)


def _operators(code, pattern, table, kind):
    for match in re.finditer(pattern, code):
        for after in table[match[1]]:
            yield Mutation(kind, match.start(1), match.end(1), after)


def _comparisons(code):
    turned = {"<": ("<=", ">"), "<=": ("<", ">="), ">": (">=", "<"), ">=": (">", "<="), "==": ("!=",), "!=": ("==",),
              "&&": ("||",), "||": ("&&",)}
    yield from _operators(code, r"(?<= )(<=|>=|==|!=|<|>|&&|\|\|)(?=\s)", turned, "comparison")
    for match in re.finditer(r"(?<=[( ])!(?=[\w(])", code):
        yield Mutation("comparison", match.start(), match.end(), "")


def _signs(code):
    turned = {"+": "-", "-": "+", "*": "/", "/": "*", "+=": ("-=",), "-=": ("+=",), "*=": ("/=",), "/=": ("*=",)}
    yield from _operators(code, r"(?<=[\w)\]] )([-+*/]=?)(?= )", turned, "sign")
    for match in re.finditer(r"(?:(?<=[(\[{])|(?<=[=,?:] )|(?<=return ))-(?=[A-Za-z(])", code):
        yield Mutation("sign", match.start(), match.end(), "")


_number = re.compile(r"(?<![\w.])(\d+\.\d*(?:e[-+]?\d+)?|\.\d+|\d+e[-+]?\d+|\d+)(f|u|U|ull)?(?![\w.'])")


def _constants(code, choice):
    for match in _number.finditer(code):
        digits, suffix = match[1], match[2] or ""
        if re.fullmatch(r"\d+", digits):
            value = int(digits)
            if value < 4:
                for after in {value + 1, abs(value - 1)}:
                    yield Mutation("off by one", match.start(), match.end(), f"{after}{suffix}")
                continue
            change = max(1, round(value * choice.uniform(0.02, 0.5)))
            yield Mutation("constant", match.start(), match.end(), f"{value + choice.choice((-1, 1)) * change}{suffix}")
        elif float(digits) != 0:
            factor = 1 + choice.choice((-1, 1)) * choice.uniform(0.02, 0.5)
            text = f"{float(digits) * factor:.6g}"
            if not re.search(r"[.e]", text):
                text += ".0"
            yield Mutation("constant", match.start(), match.end(), text + suffix)


def _bounds(code):
    for match in re.finditer(r"\b(?:\w+) (?:<|<=) ((?:[\w.]|->|::|\(\))+)(?=; )", code):
        for after in (f"{match[1]} - 1", f"{match[1]} + 1"):
            yield Mutation("off by one", match.start(1), match.end(1), after)
    for match in re.finditer(r"(?<=\w)\[([a-z]\w*)\]", code):
        yield Mutation("off by one", match.start(1), match.end(1), f"{match[1]} + 1")


# A call or an assignment, ++i, break or continue; or one of them behind `if (...)`, on one or more whole lines.
_statement = re.compile(
    r"(?:(?<=[;{}:]\n)|(?<=\n\n))[ ]+"
    r"((?:if \([^;{}\n]*\) )?(?:(?:\+\+|--)[\w.\->\[\]]+|(?:break|continue)|(?:return(?: [^;{}\n]*)?)|"
    r"[A-Za-z_][\w.:]*(?:->[\w.:]+|\[[^\];]*\]|\([^;{}]*?\)\.\w+)*(?: [-+*/|&^]?= [^;]*|\([^;]*\)|\+\+|--));)(?=\n)")


def _dropped_statements(code):
    for match in _statement.finditer(code):
        statement = match[1]
        if statement.startswith("return") or re.match(r"(using|static_assert|namespace|typedef|template)\b", statement):
            continue
        yield Mutation("dropped statement", match.start(1), match.end(1), ";" + "\n" * statement.count("\n"))


def _arguments(code):
    """Of every call and braced list with at least two arguments the text before it and the arguments' (begin, end)."""
    opening = {")": "(", "}": "{", "]": "["}
    stack = []
    for at, c in enumerate(code):
        if c in "([{":
            stack.append((c, at, [at + 1]))
        elif c in ")]}":
            if not stack or stack[-1][0] != opening[c]:
                stack.clear()  # an unbalanced region of #if: begin again
                continue
            bracket, begin, cuts = stack.pop()
            if len(cuts) > 1 and bracket != "[" and begin > 0 and ";" not in code[begin:at]:
                before = code[max(0, begin - 200) : begin]
                called = re.search(r"[\w>\]]$" if bracket == "(" else r"[\w>,=({]\s*$", before)
                if called and not re.search(r"\b(?:if|for|while|switch) $|\benum [^;]*$", before):
                    ends = [cut - 1 for cut in cuts[1:]] + [at]
                    yield before, list(zip(cuts, ends))
        elif c == "," and stack:
            stack[-1][2].append(at + 1)
        elif c == ";" and stack and stack[-1][0] == "{":
            stack[-1][2][:] = [at + 1]


# In whatever order their two arguments stand, they give the same bits.
_symmetric = re.compile(r"\b(?:dot|distance|min|max|length\((?:\w+::)?cross)$")


def _argument_faults(code, text):
    for before, arguments in _arguments(code):
        spans = []
        for begin, end in arguments:
            raw = code[begin:end]
            spans.append((begin + len(raw) - len(raw.lstrip()), end - (len(raw) - len(raw.rstrip()))))
        parts = [code[begin:end] for begin, end in spans]
        declared = r"[{}]|^const |^(?:std|ssphh)::[\w:<>]+[&*]* \w+$|[\w>][&*]+ \w+$|^(?:int|float|double|bool|auto|vec\d) \w+"
        if not all(parts) or any(re.search(declared, part) for part in parts):
            continue
        last = spans[-1]
        lines = "\n" * code.count("\n", spans[-2][1], last[1])
        yield Mutation("dropped argument", spans[-2][1], last[1], lines)
        for (b0, e0), (b1, e1) in zip(spans, spans[1:]):
            if text[b0:e0] != text[b1:e1] and not _symmetric.search(before):
                yield Mutation("swapped arguments", b0, e1, text[b1:e1] + text[e0:b1] + text[b0:e0])


def candidates(text, seed=0):
    """All faults of a file by kind. `seed` decides by how much constants change."""
    # What a program reserves, and how finely it splits a loop, changes no result.
    code = re.sub(r"[^\n]*(?:\.reserve\(|\bgrain\b)[^\n]*", lambda line: " " * len(line[0]), code_only(text))
    choice = random.Random(seed)
    found = {kind: [] for kind in KINDS}
    for source in (_comparisons(code), _signs(code), _constants(code, choice), _bounds(code), _dropped_statements(code),
                   _argument_faults(code, text)):
        for mutation in source:
            found[mutation.kind].append(mutation)
    return found


def draws(texts, seed):
    """The faults of files (name: text) one after the other: a file by its length, a kind, a place."""
    choice = random.Random(seed)
    found = {name: candidates(text, f"{seed} {name}") for name, text in texts.items()}
    found = {name: kinds for name, kinds in found.items() if any(kinds.values())}
    lengths = [texts[name].count("\n") for name in found]
    seen = set()
    while len(seen) < sum(len(places) for kinds in found.values() for places in kinds.values()):
        name = choice.choices(list(found), lengths)[0]
        kind = choice.choice([kind for kind, places in found[name].items() if places])
        mutation = choice.choice(found[name][kind])
        if (name, mutation) not in seen:
            seen.add((name, mutation))
            yield name, mutation


def show(name, text, mutation):
    """The fault as a diff of its lines."""
    first = text.rfind("\n", 0, mutation.begin) + 1
    last = text.find("\n", mutation.end)
    changed = text[first : mutation.begin] + mutation.after + text[mutation.end : last]
    strip = lambda s: re.sub(r"\s*\n\s*", " ", s.strip())
    return f"{name}:{mutation.line(text)} ({mutation.kind})\n  - {strip(text[first:last])}\n  + {strip(changed)}"
