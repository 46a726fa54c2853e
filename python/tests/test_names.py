"""The words around the code. Truth: what inspect finds is what the stubs and the page say; the examples run."""

import ast
import doctest
import glob
import importlib.util
import inspect
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import common
import ovoid

SOURCE = os.environ.get("OVOID_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", ".."))


def read(path):
    with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
        return file.read()


USER = """
import ovoid
from ovoid.trimesh_compat import CollisionManager

def clearance(half: float, gap: float) -> float:
    box = ovoid.Shape.box((half, half, half))
    answer = ovoid.distance(box, ovoid.Compound([box]), None, ovoid.Pose((2 * half + gap, 0, 0)))
    ovoid.verify(answer)
    if answer.inside is not None and answer.component is not None:
        return float(answer.component)
    return answer.lower if answer.status == ovoid.Status.SEPARATED else 0.0

def at_once(count: int) -> float:
    world = ovoid.World(threads=2)
    ids = world.add_many([ovoid.Shape.sphere(1)] * count, [(3 * i, 0, 0) for i in range(count)])
    hit = world.nearest(ids[0])
    first: float = world.contacts("distance", 2).items["lower"][0]
    return first + (hit.lower if hit else 0) + float(ovoid.Shape.sphere(1).vertices[0, 0])

def place(numbers: list[float]) -> tuple[float, ...]:
    pose = ovoid.Pose((ovoid.Pose.from_xyz_xyzw(numbers).rotation, (1, 2, 3)))
    return ovoid.Pose.from_xyz_wxyz(pose.xyz_wxyz).xyz_xyzw

def look(cell: ovoid.Cell) -> str:
    box = ovoid.Shape.box((1, 2, 3))
    picture: ovoid.Picture = ovoid.draw({"box": box, "other": (box, (9, 0, 0))}, unit="mm", layers=["names"], view=(1, 0, 0))
    picture.write("box.svg")
    shown = box._repr_html_() or ""
    return ovoid.show((cell, "ready"), margin=0.1, browser=False) + cell.show(path="a.html") + picture.svg + shown

def go(robot: ovoid.Robot) -> list[str]:
    cell = ovoid.Cell(robot)
    cell.attach("hand", ovoid.Shape.sphere(1), (0, 0, 1), name="ball")
    hit = cell.collide({"elbow": 0.5})
    names = [side.name for side in (hit.a, hit.b) if side is not None]
    near, gradients = cell.near(robot.q("ready", elbow=1), 0.1)
    names += [pair[0] for pair in cell.pair_names(near) if pair] + list(cell.names.values())
    plan = cell.plan("ready", [{"elbow": 1.0}, "up"], moving="arm", seconds=1, seed=3)
    if plan is not None and cell.find_hit(["ready", {"elbow": 1}]).status == ovoid.RobotStatus.FREE:
        names.append(f"{len(plan.states)} states of length {plan.length:g}, {plan.path.free_until:g}")
    return names + [part.link for part in robot.elements if part.solid is not None]

def manage() -> bool:
    manager = CollisionManager()
    manager.add_object("a", ovoid.Shape.sphere(1))
    hit, names = manager.in_collision_internal(return_names=True)
    return bool(hit)
"""


class Stubs(unittest.TestCase):
    @unittest.skipUnless(ovoid.has_io and ovoid.has_robot, "needs a build with files and robots")
    def test_stub(self):
        """The stub is what the package says, so every name in it has a docstring with its types."""
        folder = os.path.dirname(os.path.dirname(ovoid.__file__))
        script = os.path.join(SOURCE, "scripts/python-stubs")
        self.assertEqual(subprocess.run([sys.executable, script, "--check", folder], check=False).returncode, 0)

    def test_docstrings(self):
        """Everything public has words, and what is called has a signature that inspect reads."""
        for name in ovoid.__all__:
            item = getattr(ovoid, name)
            members = {f"{name}.{key}": getattr(item, key) for key in vars(item) if key[0] != "_"} if inspect.isclass(item) else {}
            for where, what in {name: item, **members}.items():
                if isinstance(what, (int, str)):
                    continue
                self.assertTrue(what.__doc__, where)
                if inspect.isroutine(what) and getattr(what, "__module__", None) != "enum":
                    inspect.signature(what)

    def test_arguments(self):
        """The names that C reads its arguments by are those of the signatures."""
        files = sorted(glob.glob(os.path.join(SOURCE, "python/src/**/*.[ch]"), recursive=True))
        text = "\n".join(read(path) for path in files).replace("\\\n", "")
        macros = dict(re.findall(r"#define (\w+_NAMES) (.*)", text))
        said = {}
        for name in ovoid.__all__:
            item = getattr(ovoid, name)
            for key, what in [(name, item), *(vars(item).items() if inspect.isclass(item) else [])]:
                what = getattr(item, key) if inspect.isclass(item) and key != name else what
                if callable(what) and "\n\nTypes: (" in (what.__doc__ or ""):
                    said.setdefault(key, []).append([one for one in inspect.signature(what).parameters if one not in ("self", "cls")])
        parsed = re.findall(r"static char \*names\[\] = \{([^}]*)\};(?:(?!\n\}).)*?:(\w+)\"", text, re.S)
        self.assertGreater(len(parsed), 40)
        for names, function in parsed:
            for _ in range(2):
                names = re.sub(r"\w+_NAMES", lambda found: macros[found[0]], names)
            names = re.findall(r'"(\w+)"', names)
            if function in said:
                self.assertIn(names, said[function], function)

    @unittest.skipUnless(shutil.which("mypy"), "needs mypy")
    def test_mypy(self):
        """The package, a user's file, and one with a mistake, by mypy --strict."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "user.py")
            environment = dict(os.environ, MYPYPATH=os.path.dirname(os.path.dirname(ovoid.__file__)))
            environment.pop("LD_PRELOAD", None)  # a sanitizer's runtime, which is not for mypy
            wrong = USER + "\nclearance(1, 2).status\novoid.distance(1, 2)\n"
            for what, text, errors in (["-p", "ovoid"], "", 0), ([path], USER, 0), ([path], wrong, 3):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
                run = subprocess.run(["mypy", "--strict", "--cache-dir", folder, *what], capture_output=True, text=True,
                                     check=False, env=environment)
                self.assertEqual(run.stdout.count(" error: "), errors, run.stdout + run.stderr)


class Words(unittest.TestCase):
    def test_other_names(self):
        """What other packages, and earlier versions, call by another name is told its own; all else is as in any module."""
        with self.assertRaisesRegex(AttributeError, "has no attribute 'load': it is named ovoid.read"):
            _ = ovoid.load
        with self.assertRaisesRegex(AttributeError, "has no attribute 'nothing'$"):
            _ = ovoid.nothing
        self.assertFalse(hasattr(ovoid, "check"))

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
        pages = ["docs/first-steps.md", "docs/coming-from-trimesh.md", "docs/planning.md"]
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
                    if "cell.plan(" in block and not importlib.util.find_spec("ovoid._ompl"):
                        continue
                    said = io.StringIO()
                    with contextlib.redirect_stdout(said):
                        exec(compile(block, page, "exec"), {"__name__": "page"})
                    self.assertEqual(said.getvalue(), printed, page)
        finally:
            os.chdir(before)

    @unittest.skipUnless(common.numpy and ovoid.has_io and ovoid.has_robot, "needs python3-numpy and a build with files and robots")
    def test_beside_prints_and_counts(self):
        """Ten tasks beside other packages: what ours prints, and the statements of all blocks, of which ours has never the most."""
        import contextlib
        import io

        page, names = read("docs/python-beside.md"), {}
        rows = re.findall(r"^\| (\d+\. .*?) \| (.*) \|$", page, re.M)
        self.assertEqual(len(rows), 10)
        packages = ("ovoid", "python-fcl", "coal", "trimesh", "PyBullet")
        before = os.getcwd()
        os.chdir(os.path.join(os.path.abspath(SOURCE), "examples/start"))
        self.addCleanup(os.chdir, before)
        for (title, cells), section in zip(rows, re.split(r"\n## (?=\d+\. )", page)[1:]):
            self.assertTrue(section.startswith(title + "\n"), title)
            counts = {}
            for package, block in re.findall(r"\n(?:(python-fcl|coal|trimesh|PyBullet)[^\n]*\n\n)?```(?:python|py)\n(.*?)```", section, re.S):
                nodes = ast.walk(ast.parse(block))
                counts[package or "ovoid"] = sum(isinstance(node, ast.stmt) and not isinstance(node, (ast.Import, ast.ImportFrom)) for node in nodes)
            self.assertEqual(cells, " | ".join(str(counts.get(package, "-")) for package in packages), title)
            self.assertEqual(counts["ovoid"], min(counts.values()), title)
            ((block, printed),) = re.findall(r"```python\n(.*?)```\n+It prints\n+```text\n(.*?)```", section, re.S)
            said = io.StringIO()
            with contextlib.redirect_stdout(said):
                exec(compile(block, "docs/python-beside.md", "exec"), names)
            self.assertEqual(said.getvalue(), printed, title)

    def test_docstring(self):
        self.assertEqual(doctest.testmod(ovoid).failed, 0)


if __name__ == "__main__":
    common.main()
