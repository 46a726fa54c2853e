"""Prepared shapes, bounds without a search, parts of files, couples of a world's probes.

Truth: the same queries of shapes, bit for bit; brackets that have to hold the distance; all pairs.
"""

import math
import os
import random
import unittest

import common
import ovoid

random.seed(5)
ROCKS = [ovoid.Shape.from_points([[random.gauss(0, 1) for _ in range(3)] for _ in range(n)]) for n in (1, 2, 4, 12, 30, 60)]
POSES = [ovoid.Pose.from_quaternion([random.uniform(-3, 3) for _ in range(3)], wxyz=[random.gauss(0, 1) for _ in range(4)])
         for _ in ROCKS]


def get_bits(answer):
    return (answer.status, answer.stage, answer.limit, answer.iterations, answer.lower, answer.upper, answer.point_a,
            answer.point_b, answer.normal, bytes(memoryview(answer.proof).cast("B")))


class Prepared(unittest.TestCase):
    def test_as_shapes(self):
        prepared = [ovoid.Prepared(*one) for one in zip(ROCKS, POSES)]
        for i, a in enumerate(prepared):
            self.assertEqual((a.shape, a.pose), (ROCKS[i], POSES[i]))
            for j, b in enumerate(prepared):
                for query, more in ((ovoid.collide, {}), (ovoid.within, {"margin": 0.5}), (ovoid.distance, {}), (ovoid.depth, {})):
                    expected = query(ROCKS[i], ROCKS[j], POSES[i], POSES[j], **more)
                    found = query(a, b, **more)
                    self.assertEqual(get_bits(found), get_bits(expected))
                    ovoid.verify(found)
                    again = query(a, b, earlier=found, **more)
                    self.assertEqual(get_bits(again), get_bits(query(ROCKS[i], ROCKS[j], POSES[i], POSES[j], earlier=found, **more)))

    def test_refusals(self):
        one = ovoid.Prepared(ROCKS[3])
        for call in (lambda: ovoid.collide(one, ROCKS[3]), lambda: ovoid.collide(ROCKS[3], one), lambda: ovoid.collide(one, one, POSES[0]),
                     lambda: ovoid.Prepared(POSES[0]), lambda: ovoid.Prepared(ovoid.Compound([ROCKS[3]])),
                     lambda: ovoid.distance(one, one, cap=-1), lambda: ovoid.smooth(one, one)):
            with self.assertRaises((TypeError, ovoid.Error)):
                call()


class Bounds(unittest.TestCase):
    def test_hold(self):
        for i, a in enumerate(ROCKS):
            for j, b in enumerate(ROCKS):
                answer = ovoid.depth(a, b, POSES[i], POSES[j])
                wide = ovoid.bounds(a, b, POSES[i], POSES[j])
                self.assertTrue(wide.lower <= answer.upper and answer.lower <= wide.upper)
                for direction in (answer.normal, (0, 0, 3), wide.normal):
                    gap = ovoid.gap(a, b, POSES[i], POSES[j], direction=direction)
                    self.assertLessEqual(gap, answer.upper)
                if i != j and any(answer.normal):
                    self.assertAlmostEqual(ovoid.gap(a, b, POSES[i], POSES[j], direction=answer.normal), answer.lower, delta=1e-9)
        self.assertEqual(ovoid.gap(ROCKS[3], ROCKS[4], direction=(0, 0, 0)), -math.inf)
        for call in (lambda: ovoid.bounds(ROCKS[3], None), lambda: ovoid.gap(ROCKS[3], ROCKS[4]), lambda: ovoid.gap(1, 2, direction=(1, 0, 0)),
                     lambda: ovoid.bounds(ovoid.Compound(ROCKS), ROCKS[3])):
            with self.assertRaises(TypeError):
                call()

    def test_compound(self):
        rocks = ovoid.Compound(ROCKS, POSES)
        self.assertEqual(sorted(rocks.order.tolist()), list(range(6)))
        self.assertGreater(rocks.outer.volume, rocks.inner.volume)
        self.assertTrue(math.isnan(rocks.outer.gap))
        # Each vertex is within the outer ellipsoid: (x - c)' Q^-1 (x - c) <= 1 where it is a ball, by its radii at least.
        reach = max(rocks.outer.radii)
        for rock, pose in zip(ROCKS, POSES):
            for vertex in pose.apply(rock.vertices).tolist():
                self.assertLessEqual(math.dist(vertex, rocks.outer.center), reach * (1 + 1e-9))

    @unittest.skipUnless(ovoid.has_io, "built without libovoid_io")
    def test_parts(self):
        source = os.environ.get("OVOID_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", ".."))
        path = os.path.join(source, "tests", "cli", "data", "parts.obj")
        parts = ovoid.read_parts(path)
        self.assertEqual([name for name, _ in parts], ["left part", "right/part"])
        whole = ovoid.Shape.read(path, hull=True)
        self.assertLess(sum(shape.volume for _, shape in parts), whole.volume)
        big = ovoid.read_parts(path, 2, rounding=0.5)
        self.assertAlmostEqual(big[0][1].radius, 0.5, delta=0)
        with self.assertRaises(ovoid.Error):
            ovoid.read_parts("absent.obj")


class Couples(unittest.TestCase):
    def test_any_of(self):
        world = ovoid.World()
        far = ovoid.Pose.from_rpy((50, 0, 0), (0, 0, 0))
        block = world.add(ROCKS[4], far)
        couples = [(i, j) for i in range(6) for j in range(i)]
        touching = [pair for pair in couples
                    if ovoid.collide(ROCKS[pair[0]], ROCKS[pair[1]], POSES[pair[0]], POSES[pair[1]]).status != ovoid.Status.SEPARATED]
        self.assertTrue(touching and len(touching) < len(couples))
        hit = world.find_any_of(ROCKS, POSES, couples)
        self.assertEqual({hit.a, hit.b - 2**63}, set(touching[0]))
        self.assertEqual((hit.answer.a, hit.answer.pose_b), (ROCKS[hit.a], POSES[hit.b - 2**63]))
        ovoid.verify(hit.answer)
        apart = [pair for pair in couples if pair not in touching]
        self.assertIsNone(world.find_any_of(ROCKS, POSES, apart))
        self.assertIsNone(world.find_any_of(ROCKS, POSES, []))
        more = world.add_many([ROCKS[0]] * 3, [far] * 3)
        with self.assertRaises(ovoid.Error):
            world.remove_many([more[0], more[0]])
        self.assertEqual(len(world), 4)
        world.remove_many(more)
        self.assertEqual(len(world), 1)
        # Bodies of the world come first.
        self.assertEqual(world.find_any_of(ROCKS, POSES[:5] + [far], couples).b, block)
        for bad in ([(0, 6)], [(0, -1)], [(0, 2**40)], [0, 1], "x"):
            with self.assertRaises((TypeError, ovoid.Error), msg=bad):
                world.find_any_of(ROCKS, POSES, bad)


if __name__ == "__main__":
    common.main()
