"""Bodies that are numbers alone.

Truth: the table of answers that the tests of C and C++ hold too (tests/cpp/test_hpp_swept.cpp), bit for bit; the same bodies as
Shapes, whose brackets have a common point with these; closed forms.
"""

import copy
import math
import os
import pickle
import random
import unittest

import common
import ovoid
from ovoid import SweptSphere

SOURCE = os.environ.get("OVOID_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", ".."))
QUERIES = ("collide", "distance", "depth", "contact_depth")


class Words:
    """A line of the table, read from its beginning."""

    def __init__(self, line):
        self.words = iter(line.replace("|", " ").split())

    def number(self):
        return float(next(self.words))

    def numbers(self, count=None):
        return [self.number() for _ in range(int(self.number()) if count is None else count)]

    def body(self):
        kind, sizes, rounding = next(self.words), self.numbers(), self.number()
        pose = ovoid.Pose.from_xyz_wxyz(self.numbers(7))
        make = getattr(SweptSphere, kind)
        if kind == "from_points":
            return make([sizes[i : i + 3] for i in range(0, len(sizes), 3)], pose, rounding=rounding)
        if kind == "box":
            return make(sizes, pose, rounding=rounding)
        return make(sizes, pose) if kind == "ellipsoid" else make(*sizes, pose)

    def answer(self):
        """As get_bits has it."""
        return next(self.words), self.number(), self.number(), self.numbers()


def get_bits(answer):
    return str(answer.status), answer.lower, answer.upper, [x for v in (answer.point_a, answer.point_b, answer.normal) for x in v or ()]


def make_shape(swept):
    """The Shape of the same body."""
    sizes, make = swept.sizes, getattr(ovoid.Shape, swept.kind)
    if swept.kind in ("box", "from_points"):
        return make(sizes, rounding=swept.rounding)
    return make(sizes) if swept.kind == "ellipsoid" else make(*sizes)


def get_state(swept):
    sizes = swept.sizes
    return swept.kind, sizes.tolist() if hasattr(sizes, "tolist") else sizes, swept.pose.xyz_wxyz, swept.rounding


class Swept(unittest.TestCase):
    def test_table(self):
        with open(os.path.join(SOURCE, "tests/cpp/swept_answers.txt"), encoding="ascii") as file:
            lines = [Words(line) for line in file]
        self.assertGreaterEqual(len(lines), 50)
        for line in lines:
            a, b = line.body(), line.body()
            for query in QUERIES:
                with self.subTest(a=a, b=b, query=query):
                    self.assertEqual(get_bits(getattr(a, query)(b)), line.answer())
            for again in (copy.copy(a), copy.deepcopy(a), pickle.loads(pickle.dumps(a))):
                self.assertEqual(get_state(again), get_state(a))
                self.assertEqual(get_bits(again.depth(b)), get_bits(a.depth(b)))

    def check_beside_shapes(self, a, b):
        truth = ovoid.depth(make_shape(a), make_shape(b), a.pose, b.pose)
        allowed = 1e-12 * (1 + abs(truth.upper))
        for query in QUERIES:
            found = getattr(a, query)(b)
            if found.status != "undecided":
                self.assertLessEqual(found.lower, truth.upper + allowed, (query, a, b))
                self.assertLessEqual(truth.lower, found.upper + allowed, (query, a, b))
            else:
                self.assertEqual((found.point_a, found.point_b, found.normal), (None, None, None))

    def test_beside_shapes(self):
        """The hulls lie beside their frames' origins: only a point of the hull may be taken for its middle."""
        random.seed(3)
        for i in range(120):
            offset = [random.uniform(-3, 3) for _ in range(3)]
            points = [[offset[k] + random.uniform(-1, 1) * (k < 2 or i % 3 > 0) for k in range(3)] for _ in range(1 + i % 11)]
            pose = ovoid.Pose.from_rpy([random.uniform(-1, 1) for _ in range(3)], [random.uniform(-3, 3) for _ in range(3)])
            hull = SweptSphere.from_points(points, pose, rounding=0.1 * (i % 2))
            near = pose.apply([offset]).tolist()[0]
            at = ovoid.Pose.from_rpy([x + random.uniform(-1.5, 1.5) for x in near], [random.uniform(-3, 3) for _ in range(3)])
            for other in (SweptSphere.sphere(0.2, at), SweptSphere.capsule(0.1, 0.5, at), SweptSphere.box((0.2, 0.3, 0.4), at, rounding=0.1),
                          SweptSphere.ellipsoid((0.2, 0.3, 0.4), at), SweptSphere.cylinder(0.2, 0.4, at), SweptSphere.cone(0.2, 0.4, at)):
                self.check_beside_shapes(hull, other)
                self.check_beside_shapes(other, hull)

    def test_known(self):
        ball, box = SweptSphere.sphere(0.5, (3, 0, 0)), SweptSphere.box((1, 1, 1))
        answer = box.distance(ball)
        self.assertEqual((answer.status, answer.limit), ("separated", "none"))
        self.assertTrue(answer.lower <= 1.5 <= answer.upper and answer.upper - answer.lower < 1e-11)
        self.assertEqual((answer.point_a, answer.normal), ((1, 0, 0), (1, 0, 0)))
        self.assertAlmostEqual(box.depth(SweptSphere.sphere(0.5, (0.75, 0, 0))).upper, -0.75, 12)
        self.assertIsNone(box.collide(ball).normal)
        self.assertIsNone(box.contact_depth(ball).normal)
        self.assertEqual(SweptSphere.sphere(0).collide(SweptSphere.sphere(0, (1, 0, 0))).status, "separated")
        # The axis of a cone is its pose's z, the apex at +half_length.
        cone = SweptSphere.cone(1, 2, ovoid.Pose.from_rpy((0, 0, 0), (0, math.pi / 2, 0)))
        self.assertEqual(cone.collide(SweptSphere.sphere(0.01, (1.9, 0, 0.1))).status, "separated")
        self.assertEqual(cone.collide(SweptSphere.sphere(0.01, (-1.9, 0, 0.9))).status, "overlapping")
        self.assertEqual(repr(ball), "<ovoid.SweptSphere: sphere at (3.0, 0.0, 0.0)>")
        self.assertEqual(get_state(SweptSphere.box((1, 2, 3), rounding=0.5))[:2] + (0.5,), ("box", (1.0, 2.0, 3.0), 0.5))
        with self.assertRaisesRegex(TypeError, "neither true nor false"):
            bool(answer)

    def test_refusals(self):
        point = [(0, 0, 0)]
        for make, code, sentence in (
                (lambda: SweptSphere.sphere(-1), "radius", "radius: a length from 0"),
                (lambda: SweptSphere.sphere(math.nan), "not_finite", "radius"),
                (lambda: SweptSphere.sphere(1e51), "range", "radius"),
                (lambda: SweptSphere.capsule(1, 0), "range", "half_length: a length from 1e-50"),
                (lambda: SweptSphere.capsule(-1, 1), "radius", "radius"),
                (lambda: SweptSphere.cylinder(0, 1), "range", "radius"),
                (lambda: SweptSphere.cone(1, math.inf), "not_finite", "half_length"),
                (lambda: SweptSphere.box((1, 0, 1)), "range", "half_sizes"),
                (lambda: SweptSphere.box((1, 1, 1), rounding=-1), "radius", "rounding"),
                (lambda: SweptSphere.ellipsoid((1, 1, -1)), "range", "half_axes"),
                (lambda: SweptSphere.from_points([]), None, "points"),
                (lambda: SweptSphere.from_points(point, rounding=-1), "radius", "rounding"),
                (lambda: SweptSphere.from_points(point + [(0, math.nan, 0)]), "not_finite", "point 1"),
                (lambda: SweptSphere.from_points([(0, 0, 2e50)]), "range", "point 0"),
                (lambda: SweptSphere.sphere(1, (1e51, 0, 0)), "range", "pose")):
            with self.assertRaisesRegex(ovoid.Error, sentence) as caught:
                make()
            if code:
                self.assertEqual(caught.exception.code, code, sentence)
        ball = SweptSphere.sphere(1)
        for make, sentence in ((lambda: ball.depth(ovoid.Shape.sphere(1)), "a SweptSphere is wanted"), (lambda: SweptSphere(), "SweptSphere"),
                               (lambda: SweptSphere.box((1, 1, 1), roundng=1), "did you mean 'rounding'")):
            with self.assertRaisesRegex(TypeError, sentence):
                make()


if __name__ == "__main__":
    common.main()
