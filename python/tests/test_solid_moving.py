"""Solids that move, in batches and in worlds. Truth: closed forms of an L of unit blocks; the query of each pair alone."""

import math
import unittest

import common
import ovoid
from common import needs_numpy
from test_solid import BALL, BLOCKS, L, ROUND, at, make_box

ROCK = ovoid.Shape.from_points([(math.sin(3 * i), math.sin(5 * i + 1), math.sin(7 * i + 2)) for i in range(12)])
COMPOUND = ovoid.Compound(BLOCKS)
SHAPES = [L, ROCK, COMPOUND, ROUND, BALL] * 4
POSES = [at(2.5 * math.sin(i), 2.5 * math.sin(2.3 * i), 2 * math.sin(4.1 * i), (i, 2 * i, 3 * i)) for i in range(20)]
COUPLES = [(i, k) for i in range(20) for k in range(i)]


def fly(start, end):
    return ovoid.Motion.poses(at(*start), at(*end), 1)


def values(record):
    return tuple(record.values()) if isinstance(record, dict) else tuple(record)


class Impacts(unittest.TestCase):
    def test_notch(self):
        """A ball of radius 1/4 that flies along the notch to the wall at x = 1, where the hull is long met."""
        flight = fly((5, 1.5, 0.5), (0, 1.5, 0.5))
        impact = ovoid.find_impact(L, BALL, None, flight)
        self.assertEqual(impact.status, ovoid.ImpactStatus.HIT)
        self.assertTrue(impact.free_until <= 0.75 <= impact.hit_at <= impact.free_until + 1e-6)
        self.assertTrue(impact.part_a < 20 and impact.part_b == 0 and len(impact.steps) >= 20)
        ovoid.verify(impact)
        self.assertLess(ovoid.find_impact(ovoid.Shape.hull_of(L), BALL, None, flight).hit_at, 0.7)
        for answer in (impact.hit, impact.free):
            self.assertEqual(answer.inside, ovoid.Inside.NONE)
            ovoid.verify(answer)
        self.assertTrue(impact.hit.is_within(1e-6) and impact.hit.pose_b.xyz[0] <= 1.25)
        self.assertIs(impact.hit.a, L)
        self.assertGreater(impact.free.lower, 0)

    def test_margin(self):
        impact = ovoid.find_impact(BALL, L, fly((5, 1.8, 0.5), (0, 1.8, 0.5)), margin=0.25)
        self.assertTrue(impact.free_until <= 0.7 <= impact.hit_at <= impact.free_until + 1e-6)
        self.assertTrue(impact.hit.is_within(0.25 + 1e-9))
        self.assertIs(impact.free.is_within(0.25), False)
        ovoid.verify(impact)

    def test_free(self):
        # Through the notch, and out again.
        free = ovoid.find_impact(L, BALL, None, fly((1.5, 1.5, 5), (1.5, 1.5, -5)))
        self.assertEqual((free.status, free.hit, free.hit_at), (ovoid.ImpactStatus.FREE, None, math.inf))
        ovoid.verify(free)

    def test_kinds(self):
        for body in (ROCK, COMPOUND, ROUND):
            impact = ovoid.find_impact(body, L, fly((9, 1.2, 0.4), (-9, 1.2, 0.4)))
            self.assertEqual(impact.status, ovoid.ImpactStatus.HIT)
            ovoid.verify(impact)
            ovoid.verify(impact.hit)
        inside = ovoid.find_impact(make_box(1), make_box(3), fly((0, 0, 0), (9, 0, 0)))
        self.assertEqual((inside.hit_at, inside.hit.inside), (0, ovoid.Inside.A))
        ovoid.verify(inside)

    def test_turning(self):
        # The L spins about its corner: its far corner at radius sqrt(5) sweeps past, and hits what is nearer.
        spin = ovoid.Motion.velocity(at(0), (0, 0, 0), (0, 0, 1), 6)
        self.assertEqual(ovoid.find_impact(L, BALL, spin, at(-2.3, -2.3, 0.5)).status, ovoid.ImpactStatus.FREE)
        impact = ovoid.find_impact(L, BALL, spin, at(-1, -1, 0.5))
        self.assertEqual(impact.status, ovoid.ImpactStatus.HIT)
        ovoid.verify(impact)
        low, high = spin.swept(L, 0, 6)
        self.assertTrue(high[0] >= 2 and high[1] >= math.sqrt(5) - 1e-9 and low[0] <= -2 and high[2] >= 1)


class Batches(unittest.TestCase):
    def check_batch(self, name, threads, **options):
        bodies = ovoid.Bodies(SHAPES, POSES)
        verdicts, witnesses = getattr(ovoid, name + "_batch")(bodies, COUPLES, witnesses=True, threads=threads, **options)
        for (a, b), verdict, witness in zip(COUPLES, verdicts.tolist(), witnesses.tolist()):
            answer = getattr(ovoid, name)(SHAPES[a], SHAPES[b], POSES[a], POSES[b], **options)
            status, stage, limit, iterations, lower, upper = values(verdict)
            self.assertEqual((status, limit, lower, upper), (answer.status, answer.limit, answer.lower, answer.upper), (a, b))
            self.assertEqual([tuple(x) for x in values(witness)], [answer.point_a, answer.point_b, answer.normal])
            if isinstance(answer, ovoid.Answer):
                self.assertEqual((stage, iterations), (answer.stage, answer.iterations))

    def test_as_singles(self):
        for threads in (1, 3):
            self.check_batch("collide", threads)
            self.check_batch("distance", threads)
            self.check_batch("within", threads, margin=0.5)

    def test_compounds(self):
        shapes = [COMPOUND, ROCK, BALL] * 3
        bodies = ovoid.Bodies(shapes, POSES[:9])
        couples = [(i, k) for i in range(9) for k in range(i)]
        for (a, b), verdict in zip(couples, ovoid.depth_batch(bodies, couples).tolist()):
            answer = ovoid.depth(shapes[a], shapes[b], POSES[a], POSES[b])
            self.assertEqual(values(verdict)[4:], (answer.lower, answer.upper))

    def test_one_for_all(self):
        bodies = ovoid.Bodies(L, POSES)
        first = ovoid.collide_batch(bodies, COUPLES).tolist()
        self.assertEqual(len(bodies), 20)
        bodies.move(POSES[::-1])
        self.assertEqual(ovoid.collide_batch(bodies, [(19 - a, 19 - b) for a, b in COUPLES]).tolist(), first)

    def test_refused(self):
        bodies = ovoid.Bodies([L, BALL], [None, None])
        for call, kind, sentence in ((lambda: ovoid.depth_batch(bodies, [(0, 1)]), TypeError, "depth_batch.. takes Shapes and Compounds"),
                                     (lambda: ovoid.collide_batch(bodies, [(0, 1)], proofs=ovoid.zeros("proofs", 1)), TypeError, "of Shapes alone"),
                                     (lambda: ovoid.collide_batch(bodies, [(0, 1)] * 9 + [(2, 0)]), ovoid.Error, "couple 9 names body 2 of 2"),
                                     (lambda: ovoid.collide_batch(bodies, [(0, -1)]), ovoid.Error, "couple 0 names body -1 of 2"),
                                     (lambda: ovoid.distance_batch(bodies, [(0, 1)], cap=-1), ovoid.Error, "negative"),
                                     (lambda: ovoid.Bodies([L, 3], [None, None]), TypeError, "shape 1: a Shape, Compound or Solid"),
                                     (lambda: bodies.move([None]), ovoid.Error, "2 bodies")):
            with self.assertRaisesRegex(kind, sentence):
                call()
        self.assertEqual(len(ovoid.collide_batch(bodies, [])), 0)

    def test_progress(self):
        said = []

        def say(done, total):
            said.append((done, total))
            raise LookupError("enough")

        with self.assertRaises(LookupError):
            ovoid.distance_batch(ovoid.Bodies(ROUND, POSES), COUPLES * 100, progress=say)
        self.assertTrue(0 < said[0][0] < said[0][1] == 19000)

    @needs_numpy
    def test_out(self):
        bodies = ovoid.Bodies(L, POSES)
        out = ovoid.zeros("verdicts", len(COUPLES))
        self.assertIs(ovoid.distance_batch(bodies, COUPLES, out=out), out)
        self.assertEqual(out.tobytes(), ovoid.distance_batch(bodies, COUPLES, threads=2).tobytes())


class Worlds(unittest.TestCase):
    def setUp(self):
        self.world = ovoid.World()
        self.ids = self.world.add_many(SHAPES, POSES).tolist()

    def test_contacts(self):
        """As the queries of all pairs."""
        found = {}
        for record in self.world.contacts("distance", 0.3).items.tolist():
            a, b, _, _, _, _, status, _, _, _, lower, upper = values(record)
            found[a, b] = status, lower, upper
        for i, k in COUPLES:
            answer = ovoid.distance(SHAPES[k], SHAPES[i], POSES[k], POSES[i])
            if answer.upper <= 0.3:
                status, lower, upper = found.pop((self.ids[k], self.ids[i]))
                self.assertEqual(status, answer.status)
                self.assertTrue(lower <= answer.upper and answer.lower <= upper)
                whole = self.world.proof(self.ids[k], self.ids[i])
                ovoid.verify(whole)
                is_solid = L in (SHAPES[i], SHAPES[k]) or ROUND in (SHAPES[i], SHAPES[k])
                self.assertEqual(whole.inside is not None, is_solid)
        self.assertEqual(found, {})

    def test_queries(self):
        probe, pose = make_box(0.5), at(0.5, -6)
        hits = [self.world.nearest(self.ids[0]), self.world.nearest_to(probe, pose), self.world.nearest_pair(), self.world.find_any(),
                *self.world.overlaps(probe, at(0.5, 0.5), margin=0.5), self.world.find_any_to([BALL, L], [at(50), at(0.5)])]
        for hit in hits:
            if hit.answer.inside is not None:
                ovoid.verify(hit.answer)
            self.assertLessEqual(hit.lower, hit.answer.upper)
        best = min(ovoid.distance(probe, body, pose, place).upper for body, place in zip(SHAPES, POSES))
        self.assertTrue(hits[1].answer.lower <= best and hits[1].lower <= best)
        self.assertIs(hits[1].answer.a, probe)
        self.assertIs(hits[1].answer.b, self.world.body(hits[1].b))
        overlaps = [hit.b for hit in self.world.overlaps(probe, at(0.5, 0.5))]
        self.assertEqual(overlaps, [key for key, body, place in zip(self.ids, SHAPES, POSES)
                                    if ovoid.collide(probe, body, at(0.5, 0.5), place).status != ovoid.Status.SEPARATED])
        of_two = self.world.find_any_of([L, L], [at(90), at(91, 0.3, 0.2)], [(0, 1)])
        self.assertEqual((of_two.a, of_two.b, of_two.answer.status), (0, 2**63 + 1, ovoid.Status.OVERLAPPING))
        ovoid.verify(of_two.answer)

    def test_casts(self):
        world = ovoid.World()
        only = world.add(L)
        cast = world.cast_ray((5, 1.5, 0.5), (-1, 0, 0))
        self.assertEqual(cast.body, only)
        self.assertTrue(cast.lower <= 4 <= cast.upper <= cast.lower + 1e-6)
        cast = world.cast_body(BALL, at(5, 1.5, 0.5), (-5, 0, 0))
        self.assertTrue(cast.lower <= 0.75 <= cast.upper <= cast.lower + 1e-6)


@unittest.skipUnless(ovoid.has_robot, "built without libovoid_robot")
class Cells(unittest.TestCase):
    def test_obstacle(self):
        """A ball on a rail along the notch of an L, whose hull it would hit."""
        rail = ovoid.Joint("x", "prismatic", "base", "hand", at(0, 1.5, 0.5), (1, 0, 0), 0, 5)
        robot = ovoid.Robot(["base", "hand"], [rail], [("hand", BALL)])
        cell, hull = ovoid.Cell(robot), ovoid.Cell(robot)
        key = cell.add(L)
        hull.add(ovoid.Shape.hull_of(L))
        self.assertIs(cell.bodies[key], L)
        self.assertEqual([cell.collide([x]).status for x in (0.5, 1.2, 1.3)], [ovoid.RobotStatus.HIT] * 2 + [ovoid.RobotStatus.FREE])
        self.assertEqual(hull.collide([1.3]).status, ovoid.RobotStatus.HIT)
        path = cell.find_hit([[5], [1.3]])
        self.assertEqual(path.status, ovoid.RobotStatus.FREE)
        ovoid.verify(path)
        path = cell.find_hit([[5], [0]])
        self.assertTrue(path.free_until <= 0.75 <= path.hit_at <= path.free_until + 0.01)
        ovoid.verify(path)


if __name__ == "__main__":
    common.main()
