"""Contacts. Truth: corners, areas and separations of boxes in closed form; verify(); the bits of single queries; and the tool's
answers about the same bodies, which must be the same numbers."""

import json
import math
import os
import random
import tempfile
import unittest

import common
import ovoid

TOOL = os.environ.get("OVOID_TOOL", os.path.join(os.path.dirname(ovoid.__file__), "..", "..", "ovoid"))
BOX = ovoid.Shape.box((1, 1, 1))
TEE = ovoid.Compound([BOX, BOX], [(0, 0, 0), (1, 0, 0)])
NEAR = ovoid.Pose((0.5, 0.25, 1.9))


def turned(angle, position):
    return ovoid.Pose.from_rpy(position, (0, 0, angle))


class Pairs(unittest.TestCase):
    def test_boxes(self):
        """The overlap of two squares of side 2 is [-0.5, 1] x [-0.75, 1]; the boxes are 0.1 deep."""
        m = ovoid.find_manifold(BOX, BOX, None, NEAR)
        ovoid.verify(m)
        self.assertTrue(ovoid.is_proven(m))
        self.assertEqual((m.status, m.axis, m.proof, m.limit, len(m), m.corners, m.share), ("overlapping", "face a", "facets", "none", 4, 4, 1))
        self.assertTrue(m.lower <= -0.1 + 1e-12 and m.upper >= -0.1 - 1e-12 and m.upper - m.lower < 1e-11)
        self.assertEqual(m.normal, (0, 0, 1))
        found = sorted((round(x, 12), round(y, 12)) for x, y, _ in m.points_a.tolist())
        self.assertEqual(found, [(-0.5, -0.75), (-0.5, 1), (1, -0.75), (1, 1)])
        for p, q, s in zip(m.points_a.tolist(), m.points_b.tolist(), m.separations.tolist()):
            self.assertLess(abs(s + 0.1) + abs(p[2] - 1) + abs(q[2] - 0.9), 1e-13)
        self.assertEqual([p["id"] for p in common_records(m.points)], m.ids.tolist())
        polygon = m.polygon()
        self.assertTrue(polygon.inner <= 1.5 * 1.75 <= polygon.outer <= polygon.inner + 1e-10)
        self.assertEqual((len(polygon.points), polygon.grown), (4, m.grown))
        self.assertEqual((m.a, m.b, m.pose_b, m.part_a, m.part_b), (BOX, BOX, NEAR, 0, 0))

    def test_octagon(self):
        """A square of side 2 turned by an eighth over an equal one."""
        m = ovoid.find_manifold(BOX, BOX, None, turned(math.pi / 4, (0, 0, 1.9)))
        ovoid.verify(m)
        self.assertEqual((len(m), m.corners, len(m.polygon().points)), (4, 8, 8))
        self.assertAlmostEqual(m.share, 1 / math.cos(math.pi / 8) ** 2 / (4 * (math.sqrt(2) - 1)), 6)
        self.assertAlmostEqual(m.polygon().inner, 8 * (math.sqrt(2) - 1), 9)

    def test_margin(self):
        apart = ovoid.Pose((0, 0, 2.25))
        self.assertEqual(ovoid.find_manifold(BOX, BOX, None, apart, margin=0.25 - 1e-9).axis, "none")
        none = ovoid.find_manifold(BOX, BOX, None, apart)
        ovoid.verify(none)
        self.assertEqual((len(none), none.limit, none.ids.tolist(), none.polygon().outer), (0, "cap", [], 0))
        m = ovoid.find_manifold(BOX, BOX, None, apart, margin=0.3)
        ovoid.verify(m)
        self.assertEqual((m.status, len(m), m.separations.tolist()), ("separated", 4, [0.25] * 4))

    def test_earlier(self):
        """A box that slides keeps the ids of its corners; nothing is found from another pair's manifold."""
        m, ids = None, set()
        for i in range(20):
            m = ovoid.find_manifold(BOX, BOX, None, ovoid.Pose((0.5 + 1e-3 * i, 0.25, 1.9)), earlier=m)
            ovoid.verify(m)
            ids.add(tuple(m.ids.tolist()))
            cold = ovoid.find_manifold(BOX, BOX, None, m.pose_b)
            self.assertLess(max(abs(m.lower - cold.lower), abs(m.upper - cold.upper)), 1e-9)
        self.assertEqual(len(ids), 1)
        other = ovoid.find_manifold(BOX, ovoid.Shape.sphere(1), None, NEAR, earlier=m)
        self.assertEqual(text(other.points), text(ovoid.find_manifold(BOX, other.b, None, NEAR).points))

    def test_kept_search(self):
        """Bodies whose upper bound a search proved: the cover of that search goes with the manifold."""
        pill, seen = ovoid.Shape.cylinder(0.5, 1), 0
        for a, b in ((BOX, pill), (pill, pill)):
            m = None
            for i in range(8):
                m = ovoid.find_manifold(a, b, None, ovoid.Pose.from_rpy((0.3, 0.2, 0.9 + 1e-9 * i), (0.3, 0.7, 0.1)), earlier=m, tolerance=1e-6)
                ovoid.verify(m)
                seen += m.proof == "search"
        self.assertGreater(seen, 0)

    def test_foreign(self):
        """What a search proved of one pair is not taken for another, whose features have the same numbers."""
        deep = ovoid.Pose.from_rpy((0.3, 0.2, 0.9), (0.3, 0.7, 0.1))
        m = ovoid.find_manifold(BOX, ovoid.Shape.cylinder(0.5, 1), None, deep)
        self.assertEqual(m.proof, "search")
        other = ovoid.find_manifold(BOX, ovoid.Shape.cylinder(0.25, 0.5), None, deep, earlier=m, tolerance=10)
        ovoid.verify(other)
        self.assertEqual((other.lower, other.upper), (lambda c: (c.lower, c.upper))(ovoid.find_manifold(BOX, other.b, None, deep, tolerance=10)))

    def test_swapped(self):
        random.seed(5)
        for _ in range(40):
            b = ovoid.Shape.from_points([[random.uniform(-1, 1) for _ in range(3)] for _ in range(20)])
            pose = ovoid.Pose.from_rpy([random.uniform(-1, 1) for _ in range(3)], [random.uniform(-3, 3) for _ in range(3)])
            m = ovoid.find_manifold(BOX, b, None, pose, margin=0.2)
            there, back = ovoid.find_manifold(b, BOX, pose, None, margin=0.2), m.swapped()
            for one in (m, there, back):
                ovoid.verify(one)
            self.assertEqual((there.lower, there.upper, text(there.points)), (back.lower, back.upper, text(back.points)))

    def test_solid(self):
        """A box on a square of two triangles: one contact of four points, as on one face; along the other way around too."""
        sheet = ovoid.Solid.from_triangles([(-3, -3, 0), (3, -3, 0), (3, 3, 0), (-3, 3, 0)], [(0, 1, 2), (0, 2, 3)])
        box, pose = ovoid.Shape.box((0.5, 0.6, 0.3)), ovoid.Pose((0.1, 0.2, 0.299))
        (m,) = ovoid.find_manifolds(box, sheet, pose, None)
        self.assertEqual((m.normal, len(m.points), m.proof), ((0, 0, -1), 4, "normal"))
        self.assertAlmostEqual(m.lower, -0.001, 12)
        ovoid.verify(m)
        (other,) = ovoid.find_manifolds(sheet, box, None, pose, earlier=[])
        ovoid.verify(other)
        self.assertEqual((other.lower, other.upper, text(other.points)), (m.lower, m.upper, text(m.swapped().points)))
        with self.assertRaisesRegex(ovoid.Error, "need not be convex"):
            m.polygon()

    def test_refused(self):
        for words, options in ((">= 0", {"margin": -1}), (">= 0", {"keep": math.nan}), ("1.45", {"angle": 2})):
            with self.assertRaisesRegex(ovoid.Error, words):
                ovoid.find_manifold(BOX, BOX, **options)
        with self.assertRaisesRegex(TypeError, "find_manifolds"):
            ovoid.find_manifold(TEE, BOX)
        with self.assertRaisesRegex(TypeError, "a Manifold is wanted"):
            ovoid.find_manifold(BOX, BOX, earlier=ovoid.depth(BOX, BOX))
        with self.assertRaisesRegex(TypeError, "did you mean"):
            ovoid.find_manifold(BOX, BOX, margins=1)
        solid = ovoid.Solid.from_triangles([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
        with self.assertRaisesRegex(TypeError, r"at most one Solid.*Compound\(solid.decompose\(\)\)"):
            ovoid.find_manifolds(solid, solid)
        with self.assertRaisesRegex(TypeError, "find_manifolds"):
            ovoid.find_manifold(solid, BOX)
        with self.assertRaises(TypeError):
            bool(ovoid.find_manifold(BOX, BOX))


def text(rows):
    """Records as text: those of NumPy have arrays, which do not compare."""
    return [repr(row) for row in (rows if isinstance(rows, list) else rows.tolist())]


def common_records(array):
    """Records as dicts, with NumPy and without."""
    rows = array.tolist()
    return rows if not rows or isinstance(rows[0], dict) else [dict(zip(array.dtype.names, row)) for row in rows]


class Parts(unittest.TestCase):
    def test_parts(self):
        """Part by part, each with the bits of the two parts."""
        found = ovoid.find_manifolds(TEE, BOX, None, NEAR, margin=0.1)
        self.assertEqual([(m.part_a, m.part_b, len(m)) for m in found], [(0, 0, 4), (1, 0, 4)])
        for m, x in zip(found, (0, 1)):
            ovoid.verify(m)
            self.assertEqual(text(m.points), text(ovoid.find_manifold(BOX, BOX, (x, 0, 0), NEAR, margin=0.1).points))
        again = ovoid.find_manifolds(TEE, BOX, None, ovoid.Pose((0.5, 0.25, 1.9 + 1e-12)), margin=0.1, earlier=found[::-1])
        self.assertEqual([m.ids.tolist() for m in again], [m.ids.tolist() for m in found])
        self.assertEqual(ovoid.find_manifolds(TEE, BOX, None, (9, 0, 0)), [])

    def test_earlier(self):
        """A list in another order is as good: what a search proved goes on with each part."""
        can, at = ovoid.Shape.cylinder(0.5, 1), lambda by: ovoid.Pose.from_rpy((0.3, 0.2, 0.9 + by), (0.3, 0.7, 0.1))
        pair = ovoid.Compound([can, BOX], [None, (0.2, 0, 0)])
        first = ovoid.find_manifolds(pair, can, None, at(0), tolerance=0.01)
        self.assertIn("search", [m.proof for m in first])
        found = [ovoid.find_manifolds(pair, can, None, at(1e-4), tolerance=0.01, earlier=given) for given in (first, first[::-1], None)]
        brackets = [[(m.lower, m.upper) for m in one] for one in found]
        self.assertEqual(brackets[0], brackets[1])
        self.assertNotEqual(brackets[0], brackets[2])
        for m in found[1]:
            ovoid.verify(m)


class Batches(unittest.TestCase):
    def test_bits(self):
        random.seed(3)
        shapes = [ovoid.Shape.from_points([[random.uniform(-1, 1) for _ in range(3)] for _ in range(12)]) for _ in range(8)]
        bodies = ovoid.Bodies(shapes, [ovoid.Pose.from_rpy([random.uniform(-1, 1) for _ in range(3)], (0.1, i, 0)) for i in range(8)])
        couples = [(i, k) for k in range(8) for i in range(k)]
        manifolds, points, grown = ovoid.find_manifold_batch(bodies, couples, margin=0.5)
        self.assertEqual((len(manifolds), len(points), len(grown)), (28, 28, 28))
        kept = [list(row["id"]) for row in common_records(manifolds)]
        for (a, b), row, at, e in zip(couples, common_records(manifolds), rows_of(points), grown.tolist()):
            m = ovoid.find_manifold(shapes[a], shapes[b], bodies.poses[a], bodies.poses[b], margin=0.5)
            self.assertEqual((row["lower"], row["upper"], row["count"], e), (m.lower, m.upper, len(m), m.grown))
            self.assertEqual(text(at[: len(m)]), text(m.points))
        again = ovoid.find_manifold_batch(bodies, couples, margin=0.5, manifolds=manifolds)
        self.assertIs(again[0], manifolds)
        self.assertEqual([list(row["id"]) for row in common_records(manifolds)], kept)

    def test_refused(self):
        bodies = ovoid.Bodies(BOX, [(0, 0, 0), NEAR])
        with self.assertRaisesRegex(ovoid.Error, "couple 1 names body 2 of 2") as caught:
            ovoid.find_manifold_batch(bodies, [(0, 1), (0, 2)])
        self.assertEqual(caught.exception.place, 1)
        with self.assertRaisesRegex(ovoid.Error, "manifolds: "):
            ovoid.find_manifold_batch(bodies, [(0, 1)], manifolds=ovoid.zeros("manifolds", 2))
        with self.assertRaisesRegex(TypeError, "Bodies of Shapes"):
            ovoid.find_manifold_batch(ovoid.Bodies([TEE, BOX], [(0, 0, 0), NEAR]), [(0, 1)])
        self.assertEqual(len(ovoid.find_manifold_batch(bodies, [(0, 1)], manifolds=ovoid.zeros("manifolds", 1))[0]), 1)


def rows_of(points):
    """The points of each manifold as lists of records."""
    rows = points.tolist()
    return rows if rows and isinstance(rows[0], list) else [rows[4 * i : 4 * i + 4] for i in range(len(rows) // 4)]


class Worlds(unittest.TestCase):
    def test_events(self):
        world = ovoid.World()
        a, b = world.add(BOX, None, user=7), world.add(BOX, NEAR, user=9)
        world.add(BOX, (50, 0, 0))
        world.set_material(a, friction=0.25, margin=0.5)
        world.set_material(b, friction=1, restitution=0.125)
        self.assertEqual(world.material(a), (0.5, 0.25, 0))
        for event in (0, 1):
            step = world.manifolds(margin=0.01)
            (row,) = common_records(step.items)
            self.assertEqual((row["a"], row["b"], row["user_a"], row["user_b"], row["event"], row["count"]), (a, b, 7, 9, event, 1))
            self.assertEqual((row["margin"], row["friction"], row["restitution"]), (0.51, 0.5, 0.125))
            self.assertEqual((step.begun, len(step.ended), step.kept), (1 - event, 0, event))
        m = ovoid.find_manifold(BOX, BOX, None, NEAR, margin=0.51)
        self.assertEqual(text(rows_of(step.points)[0]), text(m.points))
        self.assertEqual(step.grown.tolist(), [m.grown])
        world.move(b, (9, 0, 0))
        gone = world.manifolds(margin=0.01)
        self.assertEqual([(row["a"], row["b"]) for row in common_records(gone.ended)], [(a, b)])
        self.assertEqual(len(gone.items), 0)

    def test_refused(self):
        world = ovoid.World()
        one = world.add(BOX)
        with self.assertRaises(ovoid.Error):
            world.set_material(one, friction=-1)
        with self.assertRaises(ovoid.Error):
            world.material(one + 1)
        with self.assertRaises(ovoid.Error):
            world.manifolds(margin=-1)


@unittest.skipUnless(os.access(TOOL, os.X_OK), "the tool is not built")
class Faces(unittest.TestCase):
    """The same bodies through the tool and here: the same numbers, of shapes, compounds and shapes with radii."""

    def make_scene(self):
        random.seed(11)
        between = lambda: [round(random.uniform(-1, 1), 6) for _ in range(3)]
        objects, bodies = [], {}
        for i in range(14):
            points = [between() for _ in range(6 + i)]
            quat, xyz = [1.0] + between(), [1.5 * x for x in between()]
            kind = ({"points": points}, {"box": [1, 2, 0.5]}, {"sphere": 0.5},
                    {"compound": [{"points": points}, {"box": [1, 1, 1], "pose": {"xyz": [1, 0.5, 0]}}]})[i % 4]
            box = ovoid.Shape.box((0.5, 0.5, 0.5))
            body = (ovoid.Shape.from_points(points) if i % 4 in (0, 3) else None, ovoid.Shape.box((0.5, 1, 0.25)), ovoid.Shape.sphere(0.5),
                    None)[i % 4]
            if i % 4 == 3:
                body = ovoid.Compound([ovoid.Shape.from_points(points), box], [None, (1, 0.5, 0)])
            objects.append({"name": f"n{i}", **kind, "pose": {"xyz": xyz, "quat_wxyz": quat}})
            bodies[f"n{i}"] = (body, ovoid.Pose.from_xyz_wxyz(xyz + quat))
        return objects, bodies

    def test_tool(self):
        objects, bodies = self.make_scene()
        with tempfile.TemporaryDirectory() as folder:
            scene = os.path.join(folder, "scene.json")
            with open(scene, "w", encoding="utf-8") as file:
                json.dump({"objects": objects}, file)
            done = common.run_tool([TOOL, "check", scene, "--margin", "0.25", "--contacts", "--json"], check=False, capture_output=True, text=True)
        count = 0
        for line in map(json.loads, done.stdout.splitlines()):
            (a, pose_a), (b, pose_b) = bodies[line["a"]], bodies[line["b"]]
            found = ovoid.find_manifolds(a, b, pose_a, pose_b, margin=0.25, angle=1.45)
            told = line.get("contacts", [])
            self.assertEqual([(m.part_a, m.part_b) for m in found], [(c["part_a"], c["part_b"]) for c in told])
            for m, c in zip(found, told):
                ovoid.verify(m)
                polygon, count = m.polygon(), count + 1
                self.assertEqual((m.lower, m.upper, list(m.normal), str(m.axis), str(m.proof), str(m.limit)),
                                 (c["lower"], c["upper"], c["normal"], c["axis"], c["proof"], c["limit"]))
                self.assertEqual((m.corners, m.share, m.grown, polygon.inner, polygon.outer),
                                 (c["corners"], c["share"], c["grown"], c["inner"], c["outer"]))
                self.assertEqual((m.feature_a, m.feature_b, m.facet_a, m.facet_b), (c["feature_a"], c["feature_b"], c["facet_a"], c["facet_b"]))
                self.assertEqual(m.points_a.tolist(), [p["point_a"] for p in c["points"]])
                self.assertEqual(m.points_b.tolist(), [p["point_b"] for p in c["points"]])
                self.assertEqual(m.ids.tolist(), [p["id"] for p in c["points"]])
        self.assertGreater(count, 30)


if __name__ == "__main__":
    common.main()
