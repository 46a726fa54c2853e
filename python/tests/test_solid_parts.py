"""Solids in convex parts. Truth: closed forms of an L of width 1, which is two boxes: its hull stands out by 1.5 over the
notch of 3 by 3, one of its arms leaves the other's end at 3."""

import gc
import math
import os
import signal
import threading
import unittest

import common
import ovoid
from test_solid import ROUND

OUTLINE = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)]
POINTS = [(x, y, z) for z in (-0.5, 0.5) for x, y in OUTLINE]
CAP = [(3, 4, 5), (3, 5, 0), (3, 0, 1), (3, 1, 2)]
FACES = ([(a, c, b) for a, b, c in CAP] + [(a + 6, b + 6, c + 6) for a, b, c in CAP]
         + [face for i in range(6) for k in [(i + 1) % 6] for face in ((i, k, k + 6), (i, k + 6, i + 6))])
L = ovoid.Solid.from_triangles(POINTS, FACES)


def make_block(x, y):
    """A box from (0, 0) to (x, y)."""
    return ovoid.Shape.from_points([(a, b, z) for a in (0, x) for b in (0, y) for z in (-0.5, 0.5)])


BLOCKS = [make_block(4, 1), make_block(1, 4)]


class Making(unittest.TestCase):
    def check_cover(self, parts, most):
        audit = L.audit_parts(parts)
        self.assertLess(audit.uncovered[1], 0.01)
        self.assertLessEqual(audit.excess[0], most)
        self.assertGreater(audit.cells, 0)

    def test_made(self):
        parts = L.decompose(error=0.01)
        self.assertEqual([len(part.vertices) for part in parts], [8, 8])
        self.assertAlmostEqual(sum(part.volume for part in parts), 7, delta=1e-9)
        self.check_cover(parts, 0.01)
        self.check_cover(L.decompose(), 0.15)
        (hull,) = L.decompose(parts=1)
        self.assertEqual(len(hull.vertices), 10)
        self.check_cover([hull], 1.5)
        # They live on without the others.
        last = L.decompose(parts=2)[-1]
        gc.collect()
        self.assertEqual(len(last.vertices), 8)
        self.assertEqual(ovoid.collide(ovoid.Compound(parts), last).status, ovoid.Status.OVERLAPPING)

    def test_enlarged(self):
        (grown,) = ovoid.enlarge_parts([BLOCKS[0]], 0.25)
        for low, high, least, most in zip((0, 0, -0.5), (4, 1, 0.5), *grown.bounds):
            self.assertTrue(low - 0.3 <= least <= low - 0.25 and high + 0.25 <= most <= high + 0.3)
        # What is uncovered by 3 is covered by parts grown so.
        self.assertEqual(L.audit_parts(ovoid.enlarge_parts([BLOCKS[0]], L.audit_parts([BLOCKS[0]]).uncovered[1])).uncovered[0], 0)

    def test_refused(self):
        shell = ovoid.Solid.from_triangles(POINTS, FACES[1:])
        for call, sentence in ((lambda: shell.decompose(), "not closed"), (lambda: shell.audit_parts(BLOCKS), "not closed"),
                               (lambda: L.decompose(error=-1), "error"), (lambda: L.decompose(parts=-1), "parts"),
                               (lambda: L.decompose(parts=10**6), "1000000"), (lambda: L.audit_parts([]), "no parts"),
                               (lambda: L.audit_parts(BLOCKS, tolerance=-1), "tolerance"), (lambda: L.audit_parts(BLOCKS, cells=-1), "cells"),
                               (lambda: L.audit_parts(BLOCKS, work=-1), "cells"), (lambda: L.audit_parts(BLOCKS, cells=10), "10 cells"),
                               (lambda: L.audit_parts([ovoid.Shape.cylinder(1, 1)]), "allowance"), (lambda: ovoid.enlarge_parts([], 1), "no parts"),
                               (lambda: ovoid.enlarge_parts(BLOCKS, -1), "radius"), (lambda: ovoid.enlarge_parts(BLOCKS, float("nan")), "radius")):
            with self.assertRaisesRegex(ovoid.Error, sentence):
                call()
        for call in (lambda: L.audit_parts(3), lambda: L.audit_parts([L]), lambda: L.audit_parts(BLOCKS, progress=3),
                     lambda: L.decompose(progress=3), lambda: L.decompose(0.1), lambda: ovoid.enlarge_parts([None], 1)):
            with self.assertRaises(TypeError):
                call()


class Proving(unittest.TestCase):
    def test_closed_forms(self):
        both = L.audit_parts(BLOCKS, tolerance=1e-6)
        for lower, upper in (both.uncovered, both.excess):
            self.assertTrue(0 == lower <= upper <= 1e-6)
        one = L.audit_parts(BLOCKS[:1], tolerance=1e-6)
        self.assertTrue(one.uncovered[0] <= 3 <= one.uncovered[1] <= one.uncovered[0] + 1e-6)
        self.assertAlmostEqual(one.uncovered_point[1], 4, delta=1e-6)
        self.assertEqual(one.uncovered_part, 0)
        hull = ovoid.Shape.hull_of(L)
        whole = L.audit_parts([BLOCKS[1], hull], tolerance=0.01)
        self.assertTrue(whole.excess[0] <= 1.5 <= whole.excess[1] <= whole.excess[0] + 0.011)
        self.assertEqual(whole.excess_part, 1)
        self.assertAlmostEqual(whole.excess_point[0], 2.5, delta=0.1)
        of_parts = whole.excess_of_parts.tolist()
        self.assertEqual(len(of_parts), 2)
        self.assertTrue(0 <= of_parts[0] <= of_parts[1] == whole.excess[1])
        # A generator is a sequence too.
        self.assertEqual(L.audit_parts(part for part in BLOCKS[:1]).uncovered_part, 0)

    def test_budget(self):
        hull = ovoid.Shape.hull_of(L)
        short, long = L.audit_parts([hull], work=50), L.audit_parts([hull], cells=4096)
        self.assertLess(short.cells, long.cells)
        self.assertGreater(short.excess[1] - short.excess[0], long.excess[1] - long.excess[0])
        for audit in (short, long):
            self.assertTrue(audit.excess[0] <= 1.5 <= audit.excess[1])


class Ended(unittest.TestCase):
    """Work without an end in sight is followed, and ended by an exception of the callback or by Ctrl-C."""

    def setUp(self):
        # Excess that is the same all over a wide slot takes cells as small as the tolerance.
        self.work = lambda **options: L.audit_parts([ovoid.Shape.hull_of(L)], tolerance=1e-9, work=2**40, cells=2**22, **options)

    def test_progress(self):
        said = []

        def say(done, total):
            said.append((done, total))
            if len(said) == 3:
                raise LookupError("enough")

        with self.assertRaisesRegex(LookupError, "enough"):
            self.work(progress=say)
        self.assertEqual(said, sorted(said))
        self.assertTrue(0 < said[-1][0] < said[-1][1] == 2**40)

    def test_cuts(self):
        # A ball with bumps all over: hundreds of cuts.
        points = [[x * (1 + 0.2 * math.sin(9 * x) * math.sin(9 * y) * math.sin(9 * z)) for x in (x, y, z)] for x, y, z in ROUND.vertices.tolist()]
        bumpy, said = ovoid.Solid.from_triangles(points, ROUND.faces), []
        with self.assertRaises(ZeroDivisionError):
            bumpy.decompose(error=1e-4, progress=lambda done, total: said.append((done, total)) or 1 // 0)
        self.assertEqual(len(said), 1)
        self.assertLess(*said[0])

    def test_ctrl_c(self):
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        self.addCleanup(timer.join)
        with self.assertRaises(KeyboardInterrupt):
            self.work()


if __name__ == "__main__":
    common.main()
