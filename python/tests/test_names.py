"""The words around the code. Truth: what inspect finds is what the stubs and the page say; the examples run."""

import ast
import doctest
import inspect
import os
import re
import unittest

import common
import ovoid

SOURCE = os.environ.get("OVOID_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", ".."))


def read(path):
    with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
        return file.read()


def get_arguments(function):
    """Names of the arguments by a stub's node, without self and cls."""
    names = [argument.arg for argument in function.args.posonlyargs + function.args.args + function.args.kwonlyargs]
    return [name for name in names if name not in ("self", "cls")]


def get_name(node):
    """Of a stub's method or attribute."""
    return node.target.id if isinstance(node, ast.AnnAssign) else node.name


# What a build without libovoid_robot, or without readers of files, lacks.
OF_ROBOTS = {"Robot", "Cell", "RobotPath", "compare_states"}
OF_FILES = {"read_obstacles", "read_motion_request", "find_problems", "read_path_sources"}


class Stubs(unittest.TestCase):
    def setUp(self):
        self.tree = ast.parse(read("python/ovoid/__init__.pyi"))
        lacking = (set() if ovoid.has_robot else OF_ROBOTS) | (set() if ovoid.has_robot and ovoid.has_io else OF_FILES)
        if not ovoid.has_io:
            lacking.add("read_parts")
        self.tree.body = [node for node in self.tree.body if getattr(node, "name", None) not in lacking]

    def check_function(self, stub, function, where):
        try:
            signature = inspect.signature(function)
        except ValueError:
            self.fail(f"{where} has no signature in its docstring")
        names = [name for name in signature.parameters if name not in ("self", "cls")]
        self.assertEqual(names, get_arguments(stub), where)

    def test_functions(self):
        stubs = {node.name: node for node in self.tree.body if isinstance(node, ast.FunctionDef)}
        functions = {name for name in ovoid.__all__ if inspect.isroutine(getattr(ovoid, name))}
        self.assertEqual(set(stubs), functions)
        for name in functions - {"read"}:
            self.check_function(stubs[name], getattr(ovoid, name), name)

    def test_classes(self):
        stubs = {node.name: node for node in self.tree.body if isinstance(node, ast.ClassDef) and node.name[0] != "_"}
        classes = {name for name in ovoid.__all__ if inspect.isclass(getattr(ovoid, name))}
        imported = {alias.asname for node in self.tree.body if isinstance(node, ast.ImportFrom) for alias in node.names}
        self.assertEqual(set(stubs), classes - imported)
        for name, stub in stubs.items():
            kind = getattr(ovoid, name)
            if issubclass(kind, tuple):
                continue
            said = {get_name(node): node for node in stub.body}
            there = {key for key in vars(kind) if not key.startswith("_")}
            if not ovoid.has_io:
                there |= {"read", "read_paths", "write"} & set(said)
            self.assertEqual({key for key in said if not key.startswith("_")}, there, name)
            for key in there:
                if inspect.isroutine(getattr(kind, key, None)) and key != "tolist":
                    self.check_function(said[key], getattr(kind, key), f"{name}.{key}")
                self.assertTrue(getattr(kind, key, ovoid.read).__doc__, f"{name}.{key}")


class Words(unittest.TestCase):
    def test_page(self):
        names = {}
        for block in re.findall(r"```python\n(.*?)```", read("docs/python.md"), re.S):
            if "ovoid.Robot" in block and not ovoid.has_robot:
                continue
            # What imports begins anew, other blocks go on from the one before.
            if "import ovoid" in block:
                names = {"__name__": "page"}
            exec(compile(block, "docs/python.md", "exec"), names)

    def check_first(self, path, most):
        """The first example of a page prints what the page says."""
        import contextlib
        import io

        first = re.search(r"```python\n(.*?)```\n+It prints\n+```text\n(.*?)```", read(path), re.S)
        self.assertLessEqual(len(first[1].splitlines()), most, path)
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            exec(first[1], {})
        self.assertEqual(said.getvalue(), first[2], path)

    def test_page_prints_what_it_says(self):
        self.check_first("docs/python.md", 10)

    @unittest.skipUnless(common.numpy, "needs python3-numpy, which prints arrays so")
    def test_readme_prints_what_it_says(self):
        self.check_first("README.md", 10)

    def test_start_prints_what_it_says(self):
        """The programs of the start, the tutorials and the pages for those who come from elsewhere, run in examples/start."""
        import contextlib
        import glob
        import io

        root = os.path.abspath(SOURCE)
        pages = ["docs/first-steps.md", "docs/coming-from-trimesh.md"]
        pages += [os.path.relpath(path, root) for path in sorted(glob.glob(f"{root}/docs/tutorial-*.md"))]
        self.assertGreaterEqual(len(pages), 6)
        before = os.getcwd()
        os.chdir(f"{root}/examples/start")
        try:
            for page in pages:
                text = read(page)
                blocks = re.findall(r"```python\n(.*?)```\n+It prints\n+```text\n(.*?)```", text, re.S)
                self.assertEqual(len(blocks), text.count("```python"), f"{page}: a block without what it prints")
                for block, printed in blocks:
                    if (".read(" in block and not ovoid.has_io) or ("ovoid.Robot" in block and not ovoid.has_robot):
                        continue
                    said = io.StringIO()
                    with contextlib.redirect_stdout(said):
                        exec(compile(block, page, "exec"), {"__name__": "page"})
                    self.assertEqual(said.getvalue(), printed, page)
        finally:
            os.chdir(before)

    def test_docstring(self):
        self.assertEqual(doctest.testmod(ovoid).failed, 0)


if __name__ == "__main__":
    common.main()
