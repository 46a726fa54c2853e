"""Worlds. Truth: the queries of single pairs, and closed forms of balls in a row."""

import gc
import math
import random
import threading
import unittest

import common
import ovoid

BALL = ovoid.Shape.sphere(0.5)
random.seed(11)


def at(x, y=0, z=0):
    return ovoid.Pose.from_quaternion((x, y, z), wxyz=(1, 0, 0, 0))


def make_row(**options):
    """Balls at 0, 1.25, 2.75, 4.5: gaps of 0.25, 0.5, 0.75."""
    world = ovoid.World(**options)
    return world, [world.add(BALL, at(x)) for x in (0, 1.25, 2.75, 4.5)]


def rows(array):
    """Records as dicts, of NumPy's arrays too."""
    if isinstance(array, ovoid.Array):
        return array.tolist()
    return [dict(zip(array.dtype.names, record)) for record in array.tolist()]


class Steps(unittest.TestCase):
    def test_contacts(self):
        for threads in (1, 3):
            world, ids = make_row(threads=threads)
            found = world.contacts("distance", 0.6)
            self.assertEqual([(r["a"], r["b"]) for r in rows(found.items)], [(ids[0], ids[1]), (ids[1], ids[2])])
            for record, gap in zip(rows(found.items), (0.25, 0.5)):
                self.assertLessEqual(record["lower"], gap)
                self.assertGreaterEqual(record["upper"], gap)
            self.assertEqual(list(rows(found.witnesses)[0]["normal"]), [1, 0, 0])
            self.assertEqual((found.bodies, found.rebuilt), (4, True))
            answer = world.proof(ids[0], ids[1])
            ovoid.verify(answer)
            self.assertAlmostEqual(answer.distance, 0.25, delta=1e-8)
            world.move(ids[3], at(3.5))
            self.assertEqual(len(world.contacts("collide").items), 1)
            self.assertIsNone(world.contacts("collide").witnesses)

    def test_contacts_carry_user(self):
        world = ovoid.World()
        world.add(BALL, at(0), user=2**64 - 1)
        world.add(BALL, at(0.5), user=7)
        world.add(BALL, at(1.0))
        found = [(r["user_a"], r["user_b"]) for r in rows(world.contacts("collide").items)]
        self.assertEqual(found, [(2**64 - 1, 7), (2**64 - 1, 0), (7, 0)])
        for wrong, error in ((-1, OverflowError), (2**64, OverflowError), ("a", TypeError), (1.5, TypeError)):
            with self.assertRaises(error):
                world.add(BALL, at(0), user=wrong)
        self.assertEqual(len(world), 3)

    def test_as_pairs(self):
        shapes = [ovoid.Shape.from_points([[random.gauss(0, 1) for _ in range(3)] for _ in range(12)]) for _ in range(30)]
        poses = [ovoid.Pose.from_quaternion([random.uniform(-4, 4) for _ in range(3)],
                                            wxyz=[random.gauss(0, 1) for _ in range(4)]) for _ in shapes]
        world = ovoid.World()
        ids = world.add_many(shapes, poses).tolist()
        found = {(r["a"], r["b"]): r for r in rows(world.contacts("depth", 0.5).items)}
        for i in range(30):
            for j in range(i):
                answer = ovoid.depth(shapes[j], shapes[i], poses[j], poses[i], cap=0.5)
                record = found.get((ids[j], ids[i]))
                self.assertEqual(record is None, answer.lower > 0.5)
                if record:
                    self.assertEqual(record["status"], answer.status)
                    self.assertLessEqual(max(record["lower"], answer.lower), min(record["upper"], answer.upper))

    def test_bodies_come_and_go(self):
        world, ids = make_row()
        self.assertEqual(world.ids().tolist(), ids)
        world.remove(ids[1])
        self.assertEqual(len(world), 3)
        for stale in (lambda: world.move(ids[1], at(0)), lambda: world.pose(ids[1]), lambda: world.remove(ids[1])):
            with self.assertRaises(ovoid.Error) as caught:
                stale()
            self.assertEqual(caught.exception.code, ovoid.Code.INDEX)
        self.assertEqual(world.pose(ids[2]), at(2.75))
        self.assertIs(world.body(ids[2]), BALL)
        world.move_many([ids[0], ids[2]], [at(7), at(8)])
        self.assertEqual((world.pose(ids[0]), world.pose(ids[2])), (at(7), at(8)))
        with self.assertRaises(ovoid.Error):
            world.move_many([ids[0], ids[1]], [at(1), at(2)])
        self.assertEqual(world.pose(ids[0]), at(7))

    def test_keeps_its_shapes(self):
        world = ovoid.World()
        a = world.add(ovoid.Shape.sphere(1), at(0))
        world.add(ovoid.Compound([ovoid.Shape.box((1, 1, 1))]), at(3))
        hit = world.nearest(a)
        gc.collect()
        self.assertAlmostEqual(world.nearest(a).answer.distance, 1, delta=1e-8)
        del world
        gc.collect()
        self.assertAlmostEqual(ovoid.distance(hit.answer.a, hit.answer.b, hit.answer.pose_a, hit.answer.pose_b).distance, 1,
                               delta=1e-8)

    def test_filters(self):
        world, ids = make_row()
        world.set_ignored(ids[0], ids[1])
        self.assertFalse(world.is_pair(ids[0], ids[1]))
        self.assertEqual(len(world.contacts("distance", 0.3).items), 0)
        world.set_ignored(ids[0], ids[1], False)
        self.assertEqual(len(world.contacts("distance", 0.3).items), 1)
        world.set_groups(ids[0], 2, 2)
        world.set_groups(ids[1], 1, 1)
        self.assertEqual(len(world.contacts("distance", 0.3).items), 0)
        # Bits beyond 32 would be dropped; those of -1 and ~1 are meant.
        ball, way = ovoid.Shape.sphere(1), (1, 0, 0)
        for bits in 2**32, -2**31 - 1, 2**70:
            for call in (lambda: world.set_groups(ids[0], bits, 1), lambda: world.set_groups(ids[0], 1, bits),
                         lambda: world.add(ball, group=bits), lambda: world.add(ball, mask=bits),
                         lambda: world.add_many([ball], [way], mask=bits), lambda: world.nearest_to(ball, group=bits),
                         lambda: world.overlaps(ball, mask=bits), lambda: world.cast_ray(way, way, mask=bits),
                         lambda: world.cast_body(ball, way, way, mask=bits)):
                with self.assertRaisesRegex(ValueError, "32 bits"):
                    call()
        world.set_groups(ids[0], -1, ~2)
        self.assertEqual(len(world.contacts("distance", 0.3).items), 1)
        world.set_groups(ids[1], 2, -1)
        self.assertEqual(len(world.contacts("distance", 0.3).items), 0)
        with self.assertRaisesRegex(TypeError, "int"):
            world.set_groups(ids[0], "a", 1)

    def test_cap(self):
        # The margin is the cap: one beside it would have no effect.
        world, _ = make_row()
        with self.assertRaisesRegex(ovoid.Error, r"cap.*contacts\(\)"):
            world.contacts("distance", 0.3, cap=0.1)
        with self.assertRaisesRegex(ovoid.Error, r"cap.*overlaps\(\)"):
            world.overlaps(ovoid.Shape.sphere(1), margin=0.3, cap=0.1)


class Queries(unittest.TestCase):
    def test_nearest(self):
        world, ids = make_row()
        hit = world.nearest(ids[2])
        self.assertEqual((hit.a, hit.b), (ids[2], ids[1]))
        self.assertAlmostEqual(hit.answer.distance, 0.5, delta=1e-8)
        ovoid.verify(hit.answer)
        self.assertIsNone(world.nearest(ids[3], cap=0.5))
        hit = world.nearest_pair()
        self.assertEqual((hit.a, hit.b), (ids[0], ids[1]))
        hit = world.nearest_to(BALL, at(6))
        self.assertEqual((hit.a, hit.b), (0, ids[3]))
        self.assertAlmostEqual(hit.answer.distance, 0.5, delta=1e-8)
        self.assertEqual(hit.answer.pose_a, at(6))
        ovoid.verify(hit.answer)
        self.assertIsNone(ovoid.World().nearest_pair())

    def test_any(self):
        world, ids = make_row()
        self.assertIsNone(world.find_any())
        self.assertIsNone(world.find_any_to([BALL, BALL], [at(9), at(-3)]))
        hit = world.find_any_to([BALL, BALL], [at(9), at(4)])
        self.assertEqual((hit.a, hit.b), (1, ids[3]))
        self.assertEqual(hit.answer.pose_a, at(4))
        world.move(ids[3], at(3))
        self.assertEqual(world.find_any([ids[3]]).b, ids[2])
        self.assertEqual([hit.b for hit in world.overlaps(BALL, at(0.6), margin=0.7)], ids[:2])
        self.assertEqual(len(world.overlaps(ovoid.Shape.sphere(20))), 4)

    def test_many_overlaps(self):
        world = ovoid.World()
        world.add_many([BALL] * 50, [at(0.1 * i) for i in range(50)])
        self.assertEqual(len(world.overlaps(BALL, at(2), margin=9)), 50)

    def test_casts(self):
        world, ids = make_row()
        cast = world.cast_ray((-2, 0, 0), (1, 0, 0))
        self.assertEqual(cast.body, ids[0])
        self.assertLessEqual(cast.lower, 1.5)
        self.assertGreaterEqual(cast.upper, 1.5)
        self.assertAlmostEqual(cast.normal[0], -1)
        self.assertEqual(world.cast_ray((-2, 0, 0), (1, 0, 0), 1).body, 0)
        self.assertEqual(world.cast_ray((-2, 5, 0), (1, 0, 0)).upper, math.inf)
        cast = world.cast_body(BALL, at(9), (-7, 0, 0))
        self.assertEqual(cast.body, ids[3])
        self.assertAlmostEqual(cast.lower, 0.5)

    def test_refused(self):
        world, ids = make_row()
        for bad, kind, sentence in (
                (lambda: world.add(3), TypeError, "body: a Shape, Compound or Solid"),
                (lambda: world.add(BALL, [[1]]), ovoid.Error, r"pose: .*\(4, 4\)"),
                (lambda: world.add_many([BALL], []), ovoid.Error, "1 bodies need as many"),
                (lambda: world.add_many([3], [at(0)]), TypeError, "body 0"),
                (lambda: world.move("x", at(0)), TypeError, "id of this world"),
                (lambda: world.move(-1, at(0)), TypeError, "id of this world"),
                (lambda: world.contacts("near"), ovoid.Error, "'collide', 'within'"),
                (lambda: world.contacts("collide", 1), ovoid.Error, ""),
                (lambda: world.contacts("distance", math.nan), ovoid.Error, ""),
                (lambda: world.proof(ids[1], ids[0]), ovoid.Error, ""),
                (lambda: world.set_ignored(ids[0], ids[0]), ovoid.Error, ""),
                (lambda: world.overlaps(BALL, margin=-1), ovoid.Error, ""),
                (lambda: world.nearest(7), ovoid.Error, ""),
                (lambda: world.nearest(ids[0], cap=-1), ovoid.Error, ""),
                (lambda: world.find_any_to([BALL], []), ovoid.Error, "as many"),
                (lambda: world.cast_ray((0, 0, 0), (0, 0, 0)), ovoid.Error, ""),
                (lambda: ovoid.World(threads=0), ovoid.Error, "threads"),
                (lambda: ovoid.World(enlargement=-1), ovoid.Error, "")):
            with self.assertRaisesRegex(kind, sentence):
                bad()

    def test_two_threads(self):
        # A world that is at work refuses another thread; nothing crashes, nothing is lost.
        rock = ovoid.Shape.from_points([[random.gauss(0, 1) for _ in range(3)] for _ in range(200)])
        world = ovoid.World()
        ids = world.add_many([rock] * 300, [at(random.uniform(0, 9), random.uniform(0, 9)) for _ in range(300)]).tolist()
        refused = []

        def stir():
            for i in range(3000):
                try:
                    world.move(ids[i % 300], at(random.uniform(0, 9), random.uniform(0, 9)))
                except RuntimeError as error:
                    refused.append(error)

        thread = threading.Thread(target=stir)
        thread.start()
        while thread.is_alive():
            try:
                world.contacts("collide")
                world.find_any_to([rock], [at(20)])
            except RuntimeError as error:
                refused.append(error)
        thread.join()
        world.contacts("collide")
        self.assertEqual(len(world), 300)
        self.assertTrue(all("another thread" in str(error) for error in refused))


if __name__ == "__main__":
    common.main()
