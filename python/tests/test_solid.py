"""Solids of triangles, convex or not.

Truth: closed forms of an L of unit blocks and of boxes; the same queries of the L's two convex blocks; proofs.
"""

import copy
import math
import os
import pickle
import tempfile
import threading
import unittest

import common
import ovoid
from common import needs_numpy, numpy

# An L of height 1 around the z axis: the square (0, 0) to (2, 2) without the one from (1, 1) to (2, 2).
OUTLINE = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
POINTS = [(x, y, z) for z in (0, 1) for x, y in OUTLINE]
CAP = [(3, 4, 5), (3, 5, 0), (3, 0, 1), (3, 1, 2)]
FACES = ([(a, c, b) for a, b, c in CAP] + [(a + 6, b + 6, c + 6) for a, b, c in CAP]
         + [face for i in range(6) for k in [(i + 1) % 6] for face in ((i, k, k + 6), (i, k + 6, i + 6))])
L = ovoid.Solid.from_triangles(POINTS, FACES)
BLOCKS = [ovoid.Shape.from_points([(x, y, z) for x in (0, w) for y in (0, h) for z in (0, 1)]) for w, h in ((2, 1), (1, 2))]
BALL = ovoid.Shape.sphere(0.25)


def at(x, y=0, z=0, rpy=(0, 0, 0)):
    return ovoid.Pose.from_rpy((x, y, z), rpy)


def corners(solid):
    """The corners of each triangle."""
    points = [tuple(point) for point in solid.vertices.tolist()]
    return [[points[i] for i in face] for face in solid.faces.tolist()]


def make_box(size, inside_out=False):
    """A cube as a solid."""
    points = [(size * x, size * y, size * z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))]
    return ovoid.Solid.from_triangles(points, [face[::-1] for face in faces] if inside_out else faces)


def make_ball(turns, rows):
    """A ball of radius 1 of about 2 turns rows triangles."""
    points = [(0, 0, -1), *((math.sin(v) * math.cos(u), math.sin(v) * math.sin(u), -math.cos(v))
                            for v in (math.pi * i / rows for i in range(1, rows))
                            for u in (2 * math.pi * k / turns for k in range(turns))), (0, 0, 1)]
    faces = []
    for k in range(turns):
        ring = [1 + i * turns + k for i in range(rows - 1)]
        following = [1 + i * turns + (k + 1) % turns for i in range(rows - 1)]
        faces += [(0, following[0], ring[0]), (len(points) - 1, ring[-1], following[-1])]
        for i in range(rows - 2):
            faces += [(ring[i], following[i], following[i + 1]), (ring[i], following[i + 1], ring[i + 1])]
    return ovoid.Solid.from_triangles(points, faces)


ROUND = make_ball(24, 24)


class Making(unittest.TestCase):
    def test_report(self):
        self.assertEqual(L.report, {"points": 12, "triangles": 20, "components": 1, "edges_unmatched": 0, "edges_crowded": 0,
                                    "degenerate": 0, "duplicates": 0, "is_flat": False})
        self.assertTrue(L.is_closed and ROUND.is_closed and L.kind == "solid")
        self.assertIs(L.report["is_flat"], False)
        self.assertTrue(4.1 < ROUND.volume < 4 * math.pi / 3)
        self.assertAlmostEqual(L.volume, 3, delta=1e-12)
        self.assertAlmostEqual(L.area, 2 * 3 + 8, delta=1e-12)
        self.assertEqual(L.bounds, ((0, 0, 0), (2, 2, 1)))
        self.assertEqual(repr(L), "<ovoid.Solid: 20 triangles, 1 components, closed>")
        turned = make_box(1, inside_out=True)
        self.assertAlmostEqual(turned.volume, -8, delta=1e-12)
        self.assertEqual(turned.winding((0, 0, 0)), -1)
        open_box = ovoid.Solid.from_triangles(POINTS, FACES[:-1] + [FACES[0], (0, 0, 1)])
        self.assertEqual((open_box.is_closed, open_box.volume, open_box.winding((0.5, 0.5, 0.5))), (False, 0, None))
        self.assertEqual(open_box.kind, "surface")
        self.assertEqual((open_box.report["duplicates"], open_box.report["degenerate"]), (1, 1))

    def test_arrays(self):
        self.assertEqual(corners(L), [[POINTS[i] for i in face] for face in FACES])
        self.assertEqual(sorted(map(tuple, L.vertices.tolist())), sorted(POINTS))
        self.assertEqual(sorted(L.order.tolist()), list(range(20)))
        self.assertEqual([L.winding(point) for point in ((0.5, 1.5, 0.5), (1.5, 1.5, 0.5), (1.5, 0.5, 0.5), (0, 0, 0))], [1, 0, 1, None])

    def test_crossings(self):
        self.assertEqual(L.crossings(), (0, True, None))
        # A needle through the wall at x = 0, and again with its point outside.
        needle = POINTS + [(-1, 0.4, 0.5), (-1, 0.5, 0.4), (-1, 0.5, 0.6), (0.5, 0.45, 0.5)]
        sides = [(12, 13, 15), (13, 14, 15), (14, 12, 15), (12, 14, 13)]
        pairs, is_complete, pair = ovoid.Solid.from_triangles(needle, FACES + sides).crossings()
        self.assertTrue(pairs >= 3 and is_complete and min(pair) < 20 <= max(pair), (pairs, pair))
        self.assertEqual(ovoid.Solid.from_triangles(needle, FACES + sides).crossings(most=1)[:2], (1, False))
        needle[-1] = (-0.5, 0.45, 0.5)
        self.assertEqual(ovoid.Solid.from_triangles(needle, FACES + sides).crossings()[0], 0)

    def test_copies(self):
        for made in (pickle.loads(pickle.dumps(L)), copy.deepcopy(L)):
            self.assertEqual((made.vertices.tolist(), made.faces.tolist(), made.order.tolist()),
                             (L.vertices.tolist(), L.faces.tolist(), L.order.tolist()))
        self.assertIs(copy.copy(L), L)

        class Mesh:
            vertices, faces = POINTS, FACES

        self.assertEqual(ovoid.Solid.from_mesh(Mesh).report, L.report)

    def test_refused(self):
        make = ovoid.Solid.from_triangles
        for given, kind, place in (((POINTS, FACES[:3] + [(0, 1, 12)]), ovoid.Code.INDEX, 3),
                                   ((POINTS, FACES[:2] + [(0, -1, 2)]), ovoid.Code.INDEX, 2),
                                   ((POINTS, [(0, 1, 2**40)]), ovoid.Code.INDEX, 0),
                                   ((POINTS[:5] + [(math.nan, 0, 0)], FACES[:4]), ovoid.Code.NOT_FINITE, 5),
                                   ((POINTS, []), ovoid.Code.EMPTY, -1),
                                   (([(0, 0), (1, 1)], FACES), ovoid.Code.ARGUMENT, -1),
                                   ((POINTS, [(0, 1), (1, 2)]), ovoid.Code.ARGUMENT, -1)):
            with self.assertRaises(ovoid.Error) as raised:
                make(*given)
            self.assertEqual((raised.exception.code, raised.exception.place), (kind, place), str(raised.exception))
        for given in ((POINTS, [(0.5, 1, 2)]), (POINTS, None), (None, FACES)):
            with self.assertRaises(TypeError):
                make(*given)
        for given in (3, L.report):
            with self.assertRaises(AttributeError):
                ovoid.Solid.from_mesh(given)
        with self.assertRaises(TypeError):
            ovoid.Solid()

    @needs_numpy
    def test_strides(self):
        points, faces = numpy.array(POINTS, float), numpy.array(FACES)
        for p, f in ((numpy.asfortranarray(points), faces.astype("u2")), (numpy.repeat(points, 2, 0)[::2], faces[::-1][::-1]),
                     (points.astype("f4"), numpy.asfortranarray(faces.astype("i4")))):
            made = ovoid.Solid.from_triangles(p, f)
            self.assertEqual(corners(made), corners(L))
        for p, f in ((points.astype(complex), faces), (points.astype(">f8"), faces), (points, faces.astype(float)), (points.astype("f2"), faces)):
            with self.assertRaises(TypeError):
                ovoid.Solid.from_triangles(p, f)
        self.assertEqual((L.vertices.shape, L.faces.dtype), ((12, 3), numpy.dtype("u4")))

    def test_match_hull(self):
        cube = make_box(1)
        self.assertEqual((cube.match_hull().volume, cube.match_hull().allowance), (8, (0, 0)))
        for solid in (L, ovoid.Solid.from_triangles(cube.vertices, cube.faces.tolist()[:-1]), ovoid.Solid.from_triangles(POINTS[:3], [(0, 1, 2)])):
            self.assertIs(solid.match_hull(), None)
        ball = make_ball(12, 8).match_hull()
        self.assertTrue(0 < ball.allowance[1] < 1e-12)
        self.assertAlmostEqual(ball.volume, make_ball(12, 8).volume, delta=1e-9)

    @unittest.skipUnless(ovoid.has_io, "built without readers of files")
    def test_load(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "l.obj")
            with open(path, "w", encoding="ascii") as file:
                file.writelines(f"v {x} {y} {z}\n" for x, y, z in POINTS)
                file.write("f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n")
                file.writelines(f"f {i + 1} {k + 1} {k + 7} {i + 7}\n" for i in range(6) for k in [(i + 1) % 6])
            self.assertEqual(ovoid.Solid.read(path).report, L.report)
            self.assertAlmostEqual(ovoid.Solid.read(path, 0.5).volume, 3 / 8, delta=1e-12)
            with open(path, "a", encoding="ascii") as file:
                file.write("f 1 7 99\n")
            for call in (lambda: ovoid.Solid.read(path), lambda: ovoid.Solid.read(path + "x"), lambda: ovoid.Solid.read(3)):
                with self.assertRaises((TypeError, ovoid.Error)):
                    call()


    @unittest.skipUnless(ovoid.has_io, "built without readers of files")
    def test_kind_of_a_file(self):
        """A file is never its hull in silence: a shape where it is that, a solid or a surface else."""
        def write(name, faces, points=POINTS):
            path = os.path.join(folder, name)
            with open(path, "w", encoding="ascii") as file:
                file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points)
                file.writelines("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)
            return path

        cube = make_box(1)
        box, flat = cube.vertices.tolist(), cube.faces.tolist()
        # A plate of 2 x 2 squares, the middle of its top lower by a millionth.
        plate = [(i % 3, i // 3, 1 - (i == 4) * 1e-6) for i in range(9)] + [(i % 2 * 2, i // 2 * 2, 0) for i in range(4)]
        walls = [(0, 1, 4), (1, 2, 4), (2, 5, 4), (5, 8, 4), (8, 7, 4), (7, 6, 4), (6, 3, 4), (3, 0, 4), (9, 11, 12, 10),
                 (9, 10, 2, 1, 0), (10, 12, 8, 5, 2), (12, 11, 6, 7, 8), (11, 9, 0, 3, 6)]
        with tempfile.TemporaryDirectory() as folder:
            whole, open_, convex = write("l.obj", FACES), write("open.obj", FACES[:-2]), write("box.obj", flat, box)
            for path, words, kind in ((whole, "closed and not convex", "solid"), (open_, "4 of its edges are open", "surface")):
                with self.assertRaisesRegex(ovoid.Error, words + ".*solid.*hull") as caught:
                    ovoid.Shape.read(path)
                self.assertEqual(caught.exception.code, ovoid.Code.NOT_CONVEX)
                body = ovoid.read(path)
                self.assertEqual((body.kind, body.report), (kind, ovoid.Solid.read(path).report))
                self.assertEqual(ovoid.distance(body, BALL, None, at(1.5, 1.5, 0.5)).status, ovoid.Status.SEPARATED)
                with self.assertRaisesRegex(ValueError, "hull=True"):
                    ovoid.read(path, rounding=0.1)
                hull = ovoid.read(path, hull=True)
                self.assertEqual(hull.to_bytes(), ovoid.Shape.read(path, hull=True).to_bytes())
                self.assertEqual(ovoid.distance(hull, BALL, None, at(1.5, 1.5, 0.5)).status, ovoid.Status.OVERLAPPING)
            self.assertEqual((ovoid.read(convex).allowance, ovoid.read(convex, scale=2).volume), ((0, 0), 64))
            nearly = write("nearly.obj", walls, plate)
            for load in (ovoid.read, ovoid.Shape.read):
                self.assertTrue(0 < load(nearly).allowance[1] < 1e-5, load(nearly).allowance)
                self.assertEqual(load(nearly, hull=True).allowance, (0, 0))


class Queries(unittest.TestCase):
    def test_notch(self):
        """A ball in the notch, which the hull would fill."""
        answer = ovoid.distance(L, BALL, None, at(1.5, 1.5, 0.5))
        self.assertEqual(answer.status, ovoid.Status.SEPARATED)
        self.assertTrue(answer.lower <= 0.25 <= answer.upper and answer.upper - answer.lower < 1e-7)
        self.assertEqual((answer.surfaces_lower, answer.surfaces_upper), (answer.lower, answer.upper))
        self.assertAlmostEqual(max(abs(x) for x in answer.normal), 1, delta=1e-9)
        # The wall that the triangle is of: x = 1 or y = 1.
        wall = [POINTS[i] for i in FACES[answer.part_a]]
        self.assertTrue({x for x, _, _ in wall} == {1} or {y for _, y, _ in wall} == {1}, wall)
        gap = math.dist(answer.point_a, answer.point_b)
        self.assertAlmostEqual(gap, 0.25, delta=1e-7)
        self.assertEqual((answer.part_b, answer.inside, answer.component, answer.b), (0, ovoid.Inside.NONE, None, BALL))
        self.assertEqual((answer.is_within(0.2), answer.is_within(0.3)), (False, True))
        self.assertEqual(answer.pose_b.xyz, (1.5, 1.5, 0.5))
        ovoid.verify(answer)
        self.assertEqual((answer.distance, answer.common, answer.parting), (answer.lower, None, None))
        self.assertTrue(answer.visited > 0 and answer.tested > 0)
        touching = ovoid.distance(ovoid.Shape.from_points(POINTS), BALL, None, at(1.4, 1.4, 0.5))
        self.assertEqual(touching.status, ovoid.Status.OVERLAPPING)

    def test_without(self):
        """An answer without a Solid has None where only solids have something."""
        for body in (BLOCKS[0], ovoid.Compound(BLOCKS)):
            for answer in (ovoid.distance(body, BALL, None, at(9)), ovoid.depth(body, BALL)):
                names = ("surfaces_lower", "surfaces_upper", "inside", "component", "common", "parting")
                self.assertEqual([getattr(answer, name) for name in names], [None] * 6)
                self.assertFalse(math.isnan(answer.distance))

    def test_as_blocks(self):
        """Beside the union of two convex blocks, and in both orders."""
        for i in range(60):
            pose = at(3 * math.sin(i) + 1, 3 * math.sin(2.3 * i) + 1, 0.7 * math.sin(5 * i), (i, 2 * i, 0.3 * i))
            parts = [ovoid.distance(block, BLOCKS[0], None, pose) for block in BLOCKS]
            least = min(parts, key=lambda part: part.lower)
            for a, b, poses in ((L, BLOCKS[0], (None, pose)), (BLOCKS[0], L, (pose, None))):
                answer = ovoid.distance(a, b, *poses)
                ovoid.verify(answer)
                self.assertTrue(ovoid.is_proven(ovoid.within(a, b, *poses, margin=0.3)))
                # In the notch a block touches on two sides: no direction parts the hulls, so the bracket is wide.
                is_open = least.status == ovoid.Status.TOUCHING and answer.status == ovoid.Status.UNDECIDED
                self.assertTrue(is_open or answer.status == least.status)
                self.assertTrue(answer.lower <= least.upper and (is_open or answer.status != ovoid.Status.UNDECIDED))
                self.assertEqual(ovoid.collide(a, b, *poses).status, answer.status)
                if answer.status == ovoid.Status.SEPARATED:
                    self.assertTrue(answer.lower <= least.upper and least.lower <= answer.upper)
                    self.assertEqual(ovoid.within(a, b, *poses, margin=0.3).is_within(0.3), least.upper <= 0.3)

    def test_compound(self):
        """The two blocks as one compound are the L."""
        blocks = ovoid.Compound(BLOCKS)
        for i in range(20):
            pose = at(3 * math.sin(i) + 1, 3 * math.sin(2.3 * i) + 1, 0.7 * math.sin(5 * i), (i, 2 * i, 0.3 * i))
            answer, same = ovoid.distance(L, blocks, None, pose), ovoid.distance(L, L, None, pose)
            self.assertEqual(answer.status, same.status)
            if answer.status == ovoid.Status.SEPARATED:
                self.assertTrue(answer.lower <= same.upper and same.lower <= answer.upper)
            self.assertLess(answer.part_b, 2)
            ovoid.verify(answer)
            self.assertEqual(ovoid.collide(blocks, L, pose).status, answer.status)

    def test_flush(self):
        # The same body twice: no two triangles cross, and a point is in both.
        answer = ovoid.distance(L, L)
        self.assertEqual((answer.status, answer.inside, answer.component), (ovoid.Status.OVERLAPPING, ovoid.Inside.POINT, None))
        self.assertTrue(answer.upper < -0.1 and all(0 < x < 2 for x in answer.common))
        ovoid.verify(answer)

    def test_inside(self):
        big, small = make_box(3), make_box(1)
        answer = ovoid.distance(small, big)
        self.assertEqual((answer.status, answer.inside, answer.component), (ovoid.Status.OVERLAPPING, ovoid.Inside.A, 0))
        self.assertTrue(answer.lower <= -4 <= answer.upper < 0)
        self.assertAlmostEqual(math.hypot(*answer.parting), 1, delta=1e-12)
        self.assertGreaterEqual(answer.surfaces_lower, 2 - 1e-7)
        ovoid.verify(answer)
        self.assertEqual(ovoid.collide(big, small).inside, ovoid.Inside.B)
        # Of the surfaces alone nothing is inside.
        shell = ovoid.Solid.from_triangles(big.vertices, big.faces.tolist()[1:])
        self.assertEqual(ovoid.collide(small, shell).status, ovoid.Status.SEPARATED)

    def test_earlier(self):
        first = ovoid.distance(ROUND, L, None, at(0.9, 0.9, 0.9))
        second = ovoid.distance(ROUND, L, None, at(0.9001, 0.9, 0.9), earlier=first)
        alone = ovoid.distance(ROUND, L, None, at(0.9001, 0.9, 0.9))
        self.assertLess(second.visited, alone.visited)
        self.assertTrue(second.lower <= alone.upper and alone.lower <= second.upper)
        ovoid.verify(second)
        ovoid.verify(ovoid.distance(L, L, None, at(4), earlier=first.proof))
        ovoid.verify(ovoid.distance(L, BALL, None, at(4), earlier=ovoid.distance(BALL, BALL, None, at(4))))
        self.assertIs(first.b, L)
        self.assertGreater(first.visited, 0)

    def test_many_exclusions(self):
        """More than there is room for at first: two balls of triangles near each other."""
        answer = ovoid.distance(ROUND, ROUND, None, at(2.001, 0, 0, (0.1, 0.2, 0.3)))
        self.assertEqual(answer.status, ovoid.Status.SEPARATED)
        ovoid.verify(answer)

    def test_refused(self):
        for call in (lambda: ovoid.depth(L, L), lambda: ovoid.distance(L, ovoid.Prepared(BALL)), lambda: ovoid.distance(L, 3),
                     lambda: ovoid.Compound([L]), lambda: ovoid.Prepared(L), lambda: ovoid.bounds(L, BALL), lambda: ovoid.smooth(L, BALL),
                     lambda: ovoid.gap(L, BALL, direction=(1, 0, 0)), lambda: ovoid.find_approach(BALL, L),
                     lambda: ovoid.cast_ray(L, None, (9, 0, 0), (-1, 0, 0)), lambda: ovoid.gradient(ovoid.distance(L, BALL))):
            with self.assertRaises(TypeError):
                call()
        for call in (lambda: ovoid.distance(L, L, absolute_tolerance=-1), lambda: ovoid.within(L, L, margin=math.nan),
                     lambda: ovoid.distance(L, L, at(9e49), at(2e50)), lambda: ovoid.distance(L, L, [[1, 2], [3, 4]])):
            with self.assertRaises(ovoid.Error):
                call()

    def test_threads(self):
        expected = repr(ovoid.distance(L, L, None, at(2.5, 0.3)))
        wrong = []

        def ask():
            wrong.extend(1 for _ in range(300) if repr(ovoid.distance(L, L, None, at(2.5, 0.3))) != expected)

        threads = [threading.Thread(target=ask) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])


if __name__ == "__main__":
    common.main()
