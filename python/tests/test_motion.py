"""Motions and derivatives. Truth: closed forms of balls and boxes, difference quotients, the library's own checks."""

import math
import unittest

import common
import ovoid

BALL = ovoid.Shape.sphere(0.5)
BOX = ovoid.Shape.box((1, 1, 1))


def at(x, y=0, z=0):
    return ovoid.Pose.from_quaternion((x, y, z), wxyz=(1, 0, 0, 0))


def fly(start, end):
    return ovoid.Motion.poses(at(*start), at(*end), 1)


class Impacts(unittest.TestCase):
    def test_balls(self):
        impact = ovoid.find_impact(BALL, BALL, None, fly((5, 0, 0), (-5, 0, 0)))
        self.assertEqual(impact.status, ovoid.ImpactStatus.HIT)
        self.assertLessEqual(impact.free_until, 0.4)
        self.assertGreaterEqual(impact.hit_at, 0.4)
        self.assertLess(impact.hit_at - impact.free_until, 1e-8)
        ovoid.verify(impact)
        ovoid.verify(impact.hit)
        self.assertEqual(len(impact.steps), 1)
        margin = ovoid.find_impact(BALL, BALL, None, fly((5, 0, 0), (-5, 0, 0)), margin=1)
        self.assertAlmostEqual(margin.hit_at, 0.3, delta=1e-8)
        self.assertAlmostEqual(margin.hit.upper, 1, delta=1e-6)
        free = ovoid.find_impact(BALL, BALL, None, fly((5, 2, 0), (-5, 2, 0)))
        self.assertEqual((str(free.status), free.hit_at, free.hit), ("free", math.inf, None))
        ovoid.verify(free)

    def test_turning(self):
        # A box that spins about z sweeps a corner of radius sqrt(2); it meets a ball at 45 degrees.
        spin = ovoid.Motion.velocity(at(0), (0, 0, 0), (0, 0, 1), 1)
        impact = ovoid.find_impact(BOX, BALL, spin, at(math.sqrt(2) + 0.5 - 1e-9))
        self.assertAlmostEqual(impact.hit_at, math.pi / 4, delta=1e-3)
        ovoid.verify(impact)
        low, high = spin.swept(BOX, 0, 1)
        self.assertGreaterEqual(high[0], math.sqrt(2))
        self.assertAlmostEqual(high[2] - low[2], 2)

    def test_many_steps(self):
        # More steps than the first guess has room for: each piece of a path takes one.
        path = ovoid.Motion.path(range(300), [at(3 + 0.5 * (i % 2), i % 3) for i in range(300)])
        impact = ovoid.find_impact(BOX, BALL, None, path)
        self.assertEqual(impact.status, ovoid.ImpactStatus.FREE)
        self.assertGreater(len(impact.steps), 200)
        ovoid.verify(impact)

    def test_translation_cast(self):
        impact = ovoid.find_impact(BOX, BOX, None, ovoid.Motion.velocity(at(5), (-6, 0, 0), (0, 0, 0), 1), tolerance=1e-12)
        self.assertAlmostEqual(impact.hit_at, 0.5, delta=1e-11)

    def test_path(self):
        path = ovoid.Motion.path([0, 1, 3], [at(5), at(5, 5), at(-5, 5)])
        self.assertEqual(path.pose(1), at(5, 5))
        self.assertEqual(path.pose(9), at(-5, 5))
        impact = ovoid.find_impact(BALL, BALL, at(0, 5), path)
        self.assertAlmostEqual(impact.hit_at, 1 + 2 * 0.4, delta=1e-8)
        ovoid.verify(impact)

    def test_compounds(self):
        comb = ovoid.Compound([BALL] * 40, [at(2 * i) for i in range(40)])
        impact = ovoid.find_impact(comb, comb, None, fly((1, 9, 0.5), (1, -9, 0.5)))
        self.assertEqual(impact.status, ovoid.ImpactStatus.FREE)
        self.assertGreater(len(impact.steps), 64)
        ovoid.verify(impact)
        impact = ovoid.find_impact(comb, BALL, None, fly((6, 9, 0), (6, -9, 0)))
        self.assertEqual(impact.part_a, 3)
        self.assertAlmostEqual(impact.hit_at, 8 / 18, delta=1e-8)
        ovoid.verify(impact)
        ovoid.verify(impact.hit)

    def test_approach(self):
        near = ovoid.find_approach(BALL, BALL, None, fly((5, 2, 0), (-5, 2, 0)))
        self.assertLessEqual(near.lower, 1)
        self.assertGreaterEqual(near.upper, 1)
        self.assertLess(near.upper - near.lower, 1e-4)
        self.assertAlmostEqual(near.time, 0.5, delta=1e-2)
        ovoid.verify(near)
        ovoid.verify(near.answer)
        self.assertLessEqual(near.answer.lower, near.upper)

    def test_rays(self):
        hit = ovoid.cast_ray(BOX, at(4), (0, 0, 0), (2, 0, 0))
        self.assertLessEqual(hit.lower, 1.5)
        self.assertGreaterEqual(hit.upper, 1.5)
        self.assertAlmostEqual(hit.normal[0], -1)
        self.assertEqual(str(ovoid.cast_ray(BOX, at(4), (0, 3, 0), (1, 0, 0)).status), "free")
        self.assertEqual(str(ovoid.cast_ray(BOX, at(4), (0, 1.5, 0), (1, 0, 0), 9, radius=1).status), "hit")

    def test_refused(self):
        for bad, kind, sentence in (
                (lambda: ovoid.Motion.path([0, 0], [at(0), at(1)]), ovoid.Error, ""),
                (lambda: ovoid.Motion.path([0], [at(0), at(1)]), ovoid.Error, r"\(2,\)"),
                (lambda: ovoid.Motion.poses(at(0), at(1), -1), ovoid.Error, ""),
                (lambda: ovoid.Motion.velocity(at(0), (0, 0, math.nan), (0, 0, 0), 1), ovoid.Error, ""),
                (lambda: ovoid.find_impact(BOX, BOX, 3), TypeError, "motion_a"),
                (lambda: ovoid.find_impact(BOX, BOX, margin=-1), ovoid.Error, "negative"),
                (lambda: ovoid.find_impact(BOX, BOX, begin=2, end=1), ovoid.Error, "begin and end"),
                (lambda: ovoid.find_approach(BOX, ovoid.Compound([BOX])), TypeError, "two Shapes"),
                (lambda: fly((0, 0, 0), (1, 0, 0)).pose(math.nan), ovoid.Error, "NaN"),
                (lambda: fly((0, 0, 0), (1, 0, 0)).swept(BOX, 2, 1), ovoid.Error, "begin <= end"),
                (lambda: ovoid.cast_ray(BOX, None, (0, 0, 0), (0, 0, 0)), ovoid.Error, "ray")):
            with self.assertRaisesRegex(kind, sentence):
                bad()


class Derivatives(unittest.TestCase):
    def test_smooth_bracket(self):
        smooth = ovoid.smooth(BOX, BALL, None, at(4, 0.25, 0), order=2)
        exact = ovoid.distance(BOX, BALL, None, at(4, 0.25, 0))
        self.assertLessEqual(smooth.outer.value, exact.upper)
        self.assertGreaterEqual(smooth.inner.value, exact.lower)
        # Along x, by a central difference of the values.
        step = 1e-4
        for side in ("outer", "inner"):
            values = [getattr(ovoid.smooth(BOX, BALL, None, at(4 + s, 0.25, 0)), side).value for s in (-step, step)]
            value = getattr(smooth, side)
            self.assertAlmostEqual(value.gradient.tolist()[6], (values[1] - values[0]) / (2 * step), delta=1e-6)
            self.assertEqual(value.hessian.tolist()[6][9], value.hessian.tolist()[9][6])
            self.assertTrue(value.is_smooth)

    def test_gradient(self):
        gradient = ovoid.gradient(ovoid.distance(BOX, BALL, None, at(4)))
        self.assertTrue(gradient.has_translation)
        self.assertAlmostEqual(gradient.gradient.tolist()[6], 1, delta=1e-6)
        deep = ovoid.depth(BOX, BALL, None, at(0.9, 0.1, 0))
        gradient = ovoid.gradient(deep)
        self.assertTrue(gradient.has_translation)
        self.assertAlmostEqual(gradient.gradient.tolist()[6], 1, delta=1e-6)

    def test_refused(self):
        for bad, kind, sentence in ((lambda: ovoid.smooth(BOX, BALL, order=3), ovoid.Error, "order"),
                                    (lambda: ovoid.smooth(BOX, 3), TypeError, "b: a Shape"),
                                    (lambda: ovoid.gradient(3), TypeError, "Answer")):
            with self.assertRaisesRegex(kind, sentence):
                bad()


if __name__ == "__main__":
    common.main()
