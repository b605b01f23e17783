"""The stubs tell of every public name, and of no other; of every argument, its order and its default."""

import ast
import inspect
import os
import re
import unittest

import numpy as np

import ssphh

FOLDER = os.path.dirname(ssphh.__file__)
# What Python gives every object, and what the stubs need not repeat.
USUAL = set(dir(object)) | {"__module__", "__dict__", "__weakref__", "__repr__", "__init__"}


def stub(name):
    with open(os.path.join(FOLDER, name)) as file:
        return ast.parse(file.read())


def defined(body):
    """Name to node of what a stub defines, or takes from the stub of a topic, without private aliases."""
    found = {}
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = node
        elif isinstance(node, ast.ImportFrom) and node.level:
            body_of_topic = stub(f"{node.module}.pyi").body if node.module else []
            topic = {name: call_of(of, body_of_topic) for name, of in defined(body_of_topic).items()}
            found.update({alias.asname: topic.get(alias.name, node) for alias in node.names if alias.asname})
    return {name: node for name, node in found.items() if not name.startswith("_") or name.startswith("__")}


def call_of(node, topic):
    """What a name's stub says of its call: of a name that is annotated with a Protocol of its file that one's."""
    if not isinstance(node, ast.AnnAssign):
        return node
    protocol = node.annotation.value if isinstance(node.annotation, ast.Subscript) else node.annotation
    for cls in topic:
        if isinstance(cls, ast.ClassDef) and cls.name == getattr(protocol, "id", None):
            return next(m for m in cls.body if isinstance(m, ast.FunctionDef) and m.name == "__call__")
    return node


def stub_arguments(function):
    """(name, keyword only, default or None) of each, without self."""
    a = function.args
    defaults = [None] * (len(a.args) - len(a.defaults)) + list(a.defaults)
    found = [(arg.arg, False, default) for arg, default in zip(a.args, defaults)]
    found += [(arg.arg, True, default) for arg, default in zip(a.kwonlyargs, a.kw_defaults)]
    return [(name, only, default and ast.unparse(default)) for name, only, default in found if name != "self"]


def compiled_arguments(function):
    """The same of what pybind11 writes into the docstring: "bake(scene: ssphh.Scene, output: object = None, *, …) -> …"."""
    line = function.__doc__.splitlines()[0]
    inside = line[line.index("(") + 1 : line.rindex(")")]
    parts, depth, start = [], 0, 0
    for i, c in enumerate(inside + ","):
        depth += (c in "([{<") - (c in ")]}>" and inside[i - 1 : i + 1] != "->")
        if c == "," and depth == 0:
            parts.append(inside[start:i].strip())
            start = i + 1
    found, only = [], False
    for part in filter(None, parts):
        if part == "*":
            only = True
            continue
        name = re.match(r"\w+", part)[0]
        default = part.rsplit(" = ", 1)[1] if " = " in part else None
        if name != "self":
            found.append((name, only, default))
    return found


def value(text):
    """Of a default; floats as the library has them, and empty lists and dicts alike."""
    found = ast.literal_eval(text)
    return np.float32(found) if isinstance(found, float) else found


class Stubs(unittest.TestCase):
    def same_names(self, module, name):
        stubbed = set(defined(stub(name).body)) - {"__version__", "__all__"}
        public = {n for n in dir(module) if not n.startswith("_")}
        self.assertEqual(stubbed - public, set(), "are in the stubs only")
        self.assertEqual(public - stubbed, set(), "are in the module only")

    def same_arguments(self, function, node, where):
        if isinstance(function, type(len)) or not inspect.isfunction(function):
            arguments = compiled_arguments(function)
        stubbed = stub_arguments(node)
        self.assertEqual([a[:2] for a in stubbed], [a[:2] for a in arguments], where)
        for (name, _, mine), (_, _, theirs) in zip(stubbed, arguments):
            self.assertEqual(mine is None, theirs is None, f"{where}: default of {name}")
            if mine not in (None, "..."):
                self.assertEqual(value(mine), value(theirs), f"{where}: default of {name}")

    def test_modules_have_the_names_of_their_stubs(self):
        self.same_names(ssphh, "__init__.pyi")
        self.same_names(ssphh.sh, "sh.pyi")
        self.assertEqual(set(ssphh.__all__) - {"__version__"}, {n for n in dir(ssphh) if n[0] != "_"})

    def test_functions_have_the_arguments_of_their_stubs(self):
        for module, name in ((ssphh, "__init__.pyi"), (ssphh.sh, "sh.pyi")):
            for function, node in defined(stub(name).body).items():
                if isinstance(node, ast.FunctionDef):
                    self.same_arguments(getattr(module, function), node, function)

    def test_classes_have_the_members_and_arguments_of_their_stubs(self):
        for name, node in defined(stub("__init__.pyi").body).items():
            if not isinstance(node, ast.ClassDef) or name == "Error":
                continue
            cls = getattr(ssphh, name)
            stubbed = {n: m for n, m in defined(node.body).items() if n != "__init__"}
            members = {n for n in vars(cls) if n not in USUAL and not n.startswith("_pybind")}
            extra = {"__len__", "__eq__"} & set(vars(cls))
            self.assertEqual(set(stubbed), members | extra, name)
            for member, what in stubbed.items():
                if member in ("__len__", "__eq__"):
                    continue
                found = inspect.getattr_static(cls, member)
                is_property = isinstance(what, ast.AnnAssign) or any(
                    isinstance(d, ast.Name) and d.id == "property" for d in what.decorator_list)
                self.assertEqual(is_property, isinstance(found, property), f"{name}.{member}")
                if is_property:
                    self.assertEqual(isinstance(what, ast.AnnAssign), found.fset is not None, f"{name}.{member}")
                else:
                    self.same_arguments(getattr(cls, member), what, f"{name}.{member}")
            made = [m for m in node.body if isinstance(m, ast.FunctionDef) and m.name == "__init__"]
            if made:
                self.same_arguments(cls.__init__, made[0], name)
            else:
                self.assertRaises(TypeError, cls)

    def test_everything_has_a_docstring(self):
        for module in (ssphh, ssphh.sh):
            for name in dir(module):
                thing = getattr(module, name)
                if callable(thing) and not name.startswith("_"):
                    self.assertGreater(len(thing.__doc__.split()), 3, name)


if __name__ == "__main__":
    unittest.main()
