"""Ten real meshes, five that are closed and not convex and five that are open: nothing is said to touch what does not.

A probe is put where the mesh has none of its triangles but its hull has material: into a hole, a pocket, or the hollow of
an open mesh. Truth: the distance of a point to every triangle. Skipped where the folder of data (OVOID_DATA) is not there.
"""

import json
import math
import os
import random
import tempfile
import unittest

import common
import ovoid

SOURCE = os.path.abspath(os.environ.get("OVOID_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", "..")))
DATA = os.environ.get("OVOID_DATA", os.path.join(SOURCE, "..", "shared", "data"))
TOOL = os.environ.get("OVOID_TOOL", os.path.join(os.path.dirname(ovoid.__file__), "..", "..", "ovoid"))
CLOSED = ["compounds/072.obj", "compounds/127.obj", "compounds/134.obj", "scans/duck.obj", "scans/bunny.obj"]
LEGS = "robots/solo12/meshes/stl/"
OPEN = ["robots/panda_mbm/meshes/collision/link6.obj", LEGS + "solo12/solo12_lower_leg_left_side.stl",
        LEGS + "solo12/solo12_upper_leg_left_side.stl", LEGS + "with_foot/solo_foot.stl", "scenes/rob.obj"]
POINT = ovoid.Shape.from_points([(0, 0, 0)])


def subtract(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def measure_segment(p, a, b):
    """The distance of a point to a segment."""
    along, length = subtract(b, a), dot(subtract(b, a), subtract(b, a))
    t = min(1.0, max(0.0, dot(subtract(p, a), along) / length)) if length > 0 else 0.0
    return math.dist(p, [x + t * y for x, y in zip(a, along)])


def measure_triangle(p, a, b, c):
    """The distance of a point to a triangle."""
    best = min(measure_segment(p, a, b), measure_segment(p, b, c), measure_segment(p, c, a))
    u, v, w = subtract(b, a), subtract(c, a), subtract(p, a)
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    uu, uv, vv, wu, wv = dot(u, u), dot(u, v), dot(v, v), dot(w, u), dot(w, v)
    det = uu * vv - uv * uv
    if det > 0:
        s, t = (vv * wu - uv * wv) / det, (uu * wv - uv * wu) / det
        if s >= 0 and t >= 0 and s + t <= 1:
            best = min(best, abs(dot(w, n)) / math.sqrt(dot(n, n)))
    return best


def at(place):
    return ovoid.Pose.from_rpy(place, (0, 0, 0))


def find_pocket(solid, hull):
    """A point in the hull, outside of what is closed, as far from the triangles as any of some hundreds tried."""
    low, high = solid.bounds
    draw = random.Random(20)
    best, found = 0, None
    for _ in range(400):
        place = [draw.uniform(x, y) for x, y in zip(low, high)]
        if solid.is_closed and solid.winding(place) != 0:
            continue
        if ovoid.collide(hull, POINT, None, at(place)).status != ovoid.Status.OVERLAPPING:
            continue
        room = ovoid.distance(solid, POINT, None, at(place)).lower
        if room > best:
            best, found = room, place
    return found


def write_cube(path, half):
    """A cube as a mesh file."""
    with open(path, "w", encoding="ascii") as file:
        file.writelines(f"v {x!r} {y!r} {z!r}\n" for x in (-half, half) for y in (-half, half) for z in (-half, half))
        file.write("f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n")


@unittest.skipUnless(ovoid.has_io, "built without readers of files")
@unittest.skipUnless(os.path.isdir(DATA), "the folder of data is not there (OVOID_DATA)")
class RealMeshes(unittest.TestCase):
    def run_tool(self, *words, code=0):
        done = common.run_tool([TOOL, *words], capture_output=True, text=True)
        self.assertEqual(done.returncode, code, (words, done.stdout[-500:], done.stderr))
        return done

    def ask_tool(self, *words, code=0):
        """The only result, and the file of it."""
        self.run_tool(*words, "-o", "results.jsonl", code=code)
        with open("results.jsonl", encoding="utf-8") as file:
            (line,) = file
        return json.loads(line)

    def expect(self, status, lower, upper, low, high, slack):
        """Apart, and the bracket meets what brute force says."""
        self.assertEqual(str(status), "separated")
        self.assertTrue(0 < lower <= upper and lower <= high + slack and upper >= low - slack, (lower, upper, low, high))
        self.assertLess(upper - lower, 10 * slack)

    def check_tool(self, path, place, radius, room, slack):
        """A ball in a scene, and a cube in a file, as the tool answers and verifies them."""
        where = " ".join(map(repr, place))
        for half, low in ((radius / 2, room - radius / 2 * math.sqrt(3)), (0, room - radius)):
            if half:
                write_cube("probe.obj", half)
            else:
                ovoid.Shape.sphere(radius).write("probe.ovoid")
            probe = "probe.obj" if half else "probe.ovoid"
            answer = self.ask_tool("distance", path, probe, "--pose-b", where)
            self.expect(answer["status"], answer["lower"], answer["upper"], low, room if half else low, slack)
            self.run_tool("verify", "results.jsonl", path, probe, "--pose-b", where)
            hull = self.ask_tool("distance", path, probe, "--pose-b", where, "--hull", code=1)
            self.assertEqual((hull["status"], hull["kind_a"]), ("overlapping", "hull"))
        with open("scene.json", "w", encoding="utf-8") as file:
            json.dump({"objects": [{"name": "mesh", "mesh": path}, {"name": "probe", "sphere": radius, "pose": {"xyz": place}}]}, file)
        answer = self.ask_tool("check", "scene.json")
        self.expect(answer["status"], answer["lower"], answer["upper"], room - radius, room - radius, slack)
        self.run_tool("verify", "results.jsonl", "scene.json")
        self.assertEqual(self.ask_tool("check", "scene.json", "--hull", code=1)["status"], "overlapping")
        return answer["kind_a"]

    def check_mesh(self, name, kind):
        path = os.path.abspath(os.path.join(DATA, name))
        solid, hull = ovoid.read(path), ovoid.read(path, hull=True)
        self.assertEqual(getattr(solid, "kind", "hull"), kind)
        with self.assertRaises(ovoid.Error):
            ovoid.Shape.read(path)
        place = find_pocket(solid, hull)
        self.assertIsNotNone(place, "no pocket was found")
        points = [tuple(point) for point in solid.vertices.tolist()]
        room = min(measure_triangle(place, *(points[i] for i in face)) for face in solid.faces.tolist())
        radius, slack = room / 2, 1e-9 * math.dist(*solid.bounds)
        ball = ovoid.Shape.sphere(radius)
        answer = ovoid.distance(solid, ball, None, at(place))
        ovoid.verify(answer)
        self.expect(answer.status, answer.lower, answer.upper, room - radius, room - radius, slack)
        self.assertEqual(ovoid.collide(solid, ball, None, at(place)).status, ovoid.Status.SEPARATED)
        self.assertEqual(ovoid.collide(hull, ball, None, at(place)).status, ovoid.Status.OVERLAPPING)
        if os.access(TOOL, os.X_OK):
            self.assertEqual(self.check_tool(path, place, radius, room, slack), kind)

    def check_all(self, names, kind):
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for name in names:
                    with self.subTest(name):
                        self.check_mesh(name, kind)
            finally:
                os.chdir(before)

    def test_closed(self):
        self.check_all(CLOSED, "solid")

    def test_open(self):
        self.check_all(OPEN, "surface")

    @unittest.skipUnless(os.access(TOOL, os.X_OK), "the tool is not built")
    def test_tool_is_there(self):
        self.assertIn("ovoid", self.run_tool("--version").stdout)


if __name__ == "__main__":
    common.main()
