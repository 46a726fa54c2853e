"""Pictures and pages. Truth: the data of a page are those that the tool writes for the same bodies, robots and paths, value by value; pictures are
well-formed XML with what they were given; closed forms of how many lines and bodies there are."""

import base64
import json
import math
import os
import pickle
import re
import shutil
import tempfile
import unittest
import warnings
import webbrowser
import xml.etree.ElementTree
from unittest import mock

import common
import ovoid

SOURCE = os.environ.get("OVOID_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", ".."))
ARM = os.path.join(SOURCE, "tests", "cli", "data", "arm")
BUILD = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(ovoid.__file__))))
TOOL = os.path.join(BUILD, "ovoid")
TEMPLATE = "<title>t</title><!--ovoid-data--><p>behind</p>"
BOX = ovoid.Shape.box((1, 2, 3))
PILL = ovoid.Shape.capsule(0.5, 1)
AWAY = ovoid.Pose.from_rpy((4, 0, 0), (0, 0.7, 0))


def read_robot(**how):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ovoid.Robot.read(os.path.join(ARM, "arm.urdf"), os.path.join(ARM, "arm.srdf"), **how)


def find_texts(svg):
    return ["".join(element.itertext()) for element in xml.etree.ElementTree.fromstring(svg).iter() if element.tag.endswith("text")]


@unittest.skipUnless(ovoid.has_io, "built without libovoid_io, which draws")
class Pictures(unittest.TestCase):
    def test_answer(self):
        answer = ovoid.distance(BOX, PILL, None, AWAY)
        picture = ovoid.draw(answer, title="a <b>", unit="mm", width=300, height=200)
        self.assertIn('width="300" height="200"', picture.svg)
        texts = find_texts(picture.svg)
        self.assertIn("a <b>", texts)
        self.assertEqual(sorted(text for text in texts if text in ("a", "b")), ["a", "b"])
        self.assertTrue(any(text == "1.856 mm" for text in texts), texts)
        self.assertEqual(picture._repr_svg_(), picture.svg)
        with tempfile.TemporaryDirectory() as folder:
            picture.write(os.path.join(folder, "p.svg"))
            with open(os.path.join(folder, "p.svg"), encoding="utf-8") as file:
                self.assertEqual(file.read(), picture.svg)

    def test_items(self):
        points, faces = common.make_corner()
        solid = ovoid.Solid.from_triangles(points, faces)
        pair = ovoid.Compound([BOX, PILL], [(0, 0, 0), (0, 0, 5)])
        texts = find_texts(ovoid.draw({"box": BOX, "pill": (PILL, AWAY), "pair": (pair, (0, 9, 0)), "corner": (solid, (9, 9, 0))}).svg)
        self.assertEqual(sorted(set(texts) & {"box", "pill", "pair", "corner"}), ["box", "corner", "pair", "pill"])
        names = sorted(text for text in find_texts(ovoid.draw([(BOX, (5 * i, 0, 0)) for i in range(3)]).svg) if text.startswith("body"))
        self.assertEqual(names, ["body 0", "body 1", "body 2"])
        self.assertIn("body 1", find_texts(ovoid.draw(ovoid.Bodies(BOX, [(0, 0, 0), (9, 0, 0)])).svg))
        self.assertEqual(len([text for text in find_texts(ovoid.draw(BOX, layers=["names", "witness"]).svg)]), 0)
        for sizes in {"width": -1}, {"height": 2**32 + 100}, {"view": (0, float("nan"), 1)}:
            with self.assertRaisesRegex(ovoid.Error, "pixels"):
                ovoid.draw(BOX, **sizes)
        # Of two answers about one body that body is drawn once.
        answers = [ovoid.distance(BOX, PILL, None, (x, 0, 0)) for x in (4, -4)]
        self.assertEqual(len([text for text in find_texts(ovoid.draw(answers).svg) if text == "2.5"]), 2)
        impact = ovoid.find_impact(BOX, PILL, None, ovoid.Motion.poses((9, 0, 0), (0, 0, 0), 1))
        for item in impact, ovoid.find_approach(BOX, PILL, None, AWAY), ovoid.Prepared(BOX, AWAY), ovoid.depth(BOX, PILL):
            xml.etree.ElementTree.fromstring(ovoid.draw(item).svg)

    def test_world(self):
        world = ovoid.World()
        ids = [world.add(BOX, (3 * i, 0, 0)) for i in range(4)]
        before = [(world.pose(key), world.body(key)) for key in ids]
        texts = find_texts(ovoid.draw(world).svg)
        self.assertEqual(len([text for text in texts if text.startswith("body ")]), 4)
        self.assertIn("1", texts)
        self.assertEqual([(world.pose(key), world.body(key)) for key in ids], before)

    @unittest.skipUnless(ovoid.has_robot, "built without libovoid_robot")
    def test_robot(self):
        robot = read_robot()
        cell = ovoid.Cell(robot)
        cell.read(os.path.join(ARM, "cell.yaml"))
        self.assertLessEqual({"base", "upper", "hand"}, set(find_texts(ovoid.draw(robot).svg)))  # the fingers' names have no room
        self.assertIn("table", find_texts(ovoid.draw((cell, "up")).svg))
        self.assertNotEqual(ovoid.draw((cell, "up")).svg, ovoid.draw((cell, {"shoulder": 1})).svg)
        # A path that hits is drawn where it hits: the depth there is tiny.
        path = cell.find_hit(["up", {"shoulder": 1.4}])
        self.assertTrue(any(text.startswith("depth 5.") for text in find_texts(ovoid.draw(path).svg)))

    def test_notebooks(self):
        things = [BOX, ovoid.Compound([BOX]), ovoid.distance(BOX, PILL, None, AWAY), ovoid.Prepared(BOX)]
        for thing in things:
            shown = thing._repr_html_()
            self.assertIn(thing._repr_svg_(), shown)
            self.assertIn("&lt;ovoid.", shown)
        self.assertIsNone(ovoid.World()._repr_html_())  # nothing to draw: the text is shown
        self.assertIsNone(ovoid.Bodies(BOX, [(3 * i, 0, 0) for i in range(500)])._repr_svg_())

    def test_trouble(self):
        for items, how, sentence in (((), {}, "nothing to show"), ((3,), {}, "what is drawn"), ((BOX,), {"layers": ["inner", "faces"]}, "no layer 'faces'"),
                                     (([],), {}, "nothing to show")):
            with self.assertRaisesRegex((TypeError, ovoid.Error), sentence):
                ovoid.draw(*items, **how)
        picture = ovoid.draw(BOX)
        with tempfile.TemporaryDirectory() as folder:
            for name in ("z.png", "z.PDF", "z.html"):
                with self.assertRaisesRegex(ovoid.Error, f"{name}: the picture is svg; choose a name that says so"):
                    picture.write(os.path.join(folder, name))
            self.assertEqual(os.listdir(folder), [])
            for name in ("z.svg", "z", "z.v2"):
                picture.write(os.path.join(folder, name))
            self.assertEqual(len(os.listdir(folder)), 3)
        if ovoid.has_robot:
            robot = read_robot()
            with self.assertRaisesRegex(ovoid.Error, "one robot"):
                ovoid.draw(robot, robot)
            with self.assertRaisesRegex(ovoid.Error, "shown alone"):
                ovoid.draw(robot, BOX)
            with self.assertRaisesRegex(ovoid.Error, "no state 'away'"):
                ovoid.draw((robot, "away"))


class Paged(unittest.TestCase):
    """With a template of one line."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.template = os.path.join(self.folder, "page.html")
        with open(self.template, "w", encoding="utf-8") as file:
            file.write(TEMPLATE)
        patched = mock.patch.dict(os.environ, {"OVOID_PAGE": self.template})
        patched.start()
        self.addCleanup(patched.stop)

    def get(self, name):
        return os.path.join(self.folder, name)

    def read(self, path):
        """The data, less what is the command's alone, and the areas of faces, which only the tool writes."""
        with open(path, encoding="utf-8") as file:
            head, data, tail = re.fullmatch(r'(.*)<script id="ovoid-data" type="application/json">(.*)</script>(.*)', file.read(), re.S).groups()
        self.assertEqual((head, tail), tuple(TEMPLATE.split("<!--ovoid-data-->")))
        self.assertNotIn("<", data)
        data = json.loads(data)
        for shape in data["shapes"]:
            shape.pop("areas", None)
            if "solid" in shape:  # its hull, whose points may have another order
                shape["bytes"] = round(ovoid.Shape.from_bytes(base64.b64decode(shape["bytes"])).volume, 9)
        for key in "title", "command", "unit":
            del data[key]
        return data

    def show(self, *items, **how):
        return self.read(ovoid.show(*items, path=self.get("own.html"), browser=False, **how))

    def ask_tool(self, *words):
        common.run_tool([TOOL, *words, "--html", self.get("tool.html")], capture_output=True, check=False, cwd=self.folder)
        return self.read(self.get("tool.html"))


@unittest.skipUnless(ovoid.has_io, "built without libovoid_io, which writes answers")
class Pages(Paged):
    def test_browser(self):
        with mock.patch.object(webbrowser, "open") as opened:
            path = ovoid.show(BOX, title="</script>")
            self.addCleanup(os.remove, path)
            self.assertEqual(opened.call_args[0][0], "file://" + path)
            self.assertEqual(BOX.show(path=self.get("box.html")), self.get("box.html"))
            self.assertEqual(opened.call_count, 2)
            ovoid.distance(BOX, PILL, None, AWAY).show(self.get("box.html"), browser=False)
            self.assertEqual(opened.call_count, 2)
        self.assertEqual(len(self.read(self.get("box.html"))["bodies"]), 2)

    def test_template(self):
        for text, sentence in (("none", "stands in it 0 times"), (TEMPLATE * 2, "stands in it 2 times")):
            with open(self.template, "w", encoding="utf-8") as file:
                file.write(text)
            with self.assertRaisesRegex(ovoid.Error, sentence):
                self.show(BOX)
        os.environ["OVOID_PAGE"] = self.get("absent.html")
        with self.assertRaisesRegex(ovoid.Error, "cannot be read"):
            self.show(BOX)
        del os.environ["OVOID_PAGE"]
        with mock.patch.dict(os.environ, {"PATH": self.folder}), mock.patch("pathlib.Path.is_file", return_value=False):
            with self.assertRaisesRegex(ovoid.Error, '"make page" in ovoid.s sources builds it'):
                self.show(BOX)

    def test_answers(self):
        """A pair keeps its answer, whatever was asked; infinities are null."""
        answer = ovoid.within(BOX, PILL, None, AWAY, margin=0.1)
        data = self.show(answer)
        self.assertEqual([(pair["a"], pair["b"]) for pair in data["pairs"]], [(0, 1)])
        self.assertEqual(data["pairs"][0]["answer"]["lower"], answer.lower)
        pair = ovoid.Compound([BOX, PILL], [(0, 0, 0), (0, 0, 5)])
        told = self.show(ovoid.distance(PILL, pair, (4, 0, 9)))["pairs"][0]["answer"]
        self.assertEqual((told.get("part_a"), told["part_b"], told["kind_b"]), (None, 1, "parts"))
        far = ovoid.collide(BOX, PILL, None, (1e3, 0, 0))
        self.assertEqual(self.show(far)["pairs"][0]["answer"]["upper"], far.upper if math.isfinite(far.upper) else None)
        world = ovoid.World()
        for i in range(3):
            world.add(BOX, (3 * i, 0, 0))
        self.assertEqual([sorted((pair["a"], pair["b"])) for pair in self.show(world)["pairs"]], [[0, 1], [1, 2]])

    @unittest.skipUnless(os.path.exists(TOOL), "the tool is not built")
    def test_as_the_tool(self):
        scene = {"objects": [{"name": "box", "box": [1, 2, 3], "pose": {"xyz": [0, 0, 0]}}, {"name": "ball", "sphere": 1, "pose": {"xyz": [4, 0.5, 0]}},
                             {"name": "pill", "capsule": {"radius": 0.5, "length": 2}, "pose": {"xyz": [4, 0, 0], "rpy": [0, 0.7, 0]}}]}
        with open(self.get("scene.json"), "w", encoding="utf-8") as file:
            json.dump(scene, file)
        obstacles = ovoid.read_obstacles(self.get("scene.json")) if ovoid.has_robot else []
        if obstacles:
            self.assertEqual(self.show({one.name: (one.shape, one.pose) for one in obstacles}), self.ask_tool("view", "scene.json"))
        points, faces = common.make_corner()
        with open(self.get("corner.off"), "w", encoding="utf-8") as file:
            file.write(f"OFF\n{len(points)} {len(faces)} 0\n" + "".join("%d %d %d\n" % p for p in points) + "".join("3 %d %d %d\n" % f for f in faces))
        PILL.write(self.get("pill.ovoid"))
        corner, pill = ovoid.read(self.get("corner.off")), ovoid.read(self.get("pill.ovoid"))
        for x in 1.5, 0.5:
            data = self.show({"corner.off": corner, "pill.ovoid": (pill, (x, 1.6, 0.5))})
            self.assertEqual(data, self.ask_tool("view", "corner.off", "pill.ovoid", "--pose-b", f"{x} 1.6 0.5"))
            self.assertIn("solid", data["shapes"][0])


@unittest.skipUnless(ovoid.has_io and ovoid.has_robot, "built without readers of robots")
class Robots(Paged):
    def make(self, **how):
        cell = ovoid.Cell(read_robot(**how))
        cell.read(os.path.join(ARM, "cell.yaml"), paddings={None: 0.01})
        return cell

    @unittest.skipUnless(os.path.exists(TOOL), "the tool is not built")
    def test_as_the_tool(self):
        for words, how in ((), {}), (("--free-base",), {"fixed_base": False}), (("--parts",), {"parts": True}):
            cell = self.make(**how)
            files = [os.path.join(ARM, "arm.urdf"), "--srdf", os.path.join(ARM, "arm.srdf"), "--scene", os.path.join(ARM, "cell.yaml"), *words]
            files += ["--padding", "0.01"]
            data = self.show((cell, ["up", {"shoulder": 1.4}, {"shoulder": 9}]), margin=0.02)
            told = self.ask_tool("robot", "check", *files, "--state", "up", "--state", "shoulder=1.4", "--state", "shoulder=9", "--margin", "0.02")
            for answer in told["robot"]["answers"][1:]:
                del answer["name"]
            self.assertEqual([answer["status"] for answer in data["robot"]["answers"]], ["free", "hit", "refused"])
            self.assertEqual(data, told)
            for end, status in (1.4, "hit"), (0.2, "free"), (9, "refused"):
                path = self.make(**how).find_hit(["up", {"shoulder": end}], margin=0.005)
                data = self.show(path)
                self.assertEqual(data["robot"]["path"]["edges"][0]["status"], status)
                self.assertEqual(data, self.ask_tool("robot", "path", *files, "--state", "up", "--state", f"shoulder={end}", "--limit-slack", "0", "--margin", "0.005"))

    def test_held(self):
        cell = self.make()
        cell.attach("hand", ovoid.Compound([BOX, PILL]), (9, 0, 0), name="tool")
        cell.add(BOX, (0, 0, 9), name="table")
        data = self.show((cell, [0.5, 0, 0]))["robot"]
        self.assertEqual([(one["name"], one["link"], one["touching"]) for one in data["held"]], [("tool", "hand", ["hand"])] * 2)
        self.assertEqual([one["name"] for one in data["obstacles"]], ["table", "pillar", "table"])
        again = ovoid.Cell(pickle.loads(pickle.dumps(cell.robot)))
        self.assertEqual(self.show(again)["robot"]["states"], [again.robot.default_state()])


if __name__ == "__main__":
    common.main()
