"""Pickles and copies. Truth: the bits of what was pickled, verify() of what came back, and other processes."""

import copy
import math
import multiprocessing
import pickle
import random
import unittest

import common
import ovoid

BOX = ovoid.Shape.box((1, 2, 3), allowance=(0.01, 0))
PILL = ovoid.Shape.capsule(0.5, 1)
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
SOLID = ovoid.Solid.from_triangles([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], FACES)
PAIR = ovoid.Compound([PILL, BOX], [(0, 0, 0), (1, 0, 0)])
TURNED = ovoid.Pose.from_rpy((4, 0.1, 0.2), (0.1, 0.7, 0))
DEEP = ovoid.Pose.from_rpy((0.3, 0.2, 0.1), (0.1, 0.7, 0))


def make_motions():
    return [ovoid.Motion.still(TURNED), ovoid.Motion.velocity(TURNED, (-3, 0, 0), (0.1, 0.2, 0.3), 2, pivot=(0.1, 0, 0)),
            ovoid.Motion.poses(TURNED, None, 3), ovoid.Motion.path([0, 1, 3], [TURNED, DEEP, None])]


def make_answers():
    """Of every kind of body and query, apart and overlapping."""
    made = []
    for a, b in [(BOX, PILL), (PAIR, BOX), (SOLID, PILL), (SOLID, PAIR), (PAIR, PAIR)]:
        for pose in (TURNED, DEEP):
            made += [ask(a, b, None, pose) for ask in (ovoid.collide, ovoid.distance, ovoid.depth) if ask is not ovoid.depth or SOLID not in (a, b)]
            made.append(ovoid.within(a, b, None, pose, margin=0.5, relative_tolerance=1e-3))
    return made


def make_events():
    motion = make_motions()
    return [ovoid.find_impact(a, b, None, motion[k]) for k in (1, 2, 3) for a, b in ((BOX, PILL), (PAIR, BOX), (SOLID, PILL))] + [
        ovoid.find_approach(BOX, PILL, None, motion[1])]


def get_fields(value):
    """Each attribute as text: of arrays their numbers, of answers their own."""
    names = [name for name in dir(type(value)) if not name.startswith("_") and not callable(getattr(value, name))]
    values = {name: getattr(value, name) for name in names}
    return {name: repr(it.tolist() if hasattr(it, "tolist") else it) for name, it in values.items()}


def ask_again(answer):
    """In another process."""
    ovoid.verify(answer)
    return ovoid.distance(answer.a, answer.b, answer.pose_a, answer.pose_b, earlier=answer)


class Values(unittest.TestCase):
    def check(self, value):
        for again in [pickle.loads(pickle.dumps(value, protocol)) for protocol in range(2, 6)] + [copy.copy(value), copy.deepcopy(value)]:
            self.assertIs(type(again), type(value))
            self.assertEqual(get_fields(again), get_fields(value))
        return again

    def test_answers(self):
        for answer in make_answers():
            with self.subTest(answer=answer, a=answer.a, b=answer.b):
                again = self.check(answer)
                ovoid.verify(again)

    def test_manifolds(self):
        near = ovoid.Pose((1.9, 0.2, 0.1))
        made = [ovoid.find_manifold(a, b, None, pose, margin=0.5) for a, b in ((BOX, PILL), (PILL, BOX), (BOX, BOX)) for pose in (near, DEEP, TURNED)]
        made += ovoid.find_manifolds(PAIR, BOX, None, DEEP, margin=0.5, angle=0.1)
        self.assertGreater(len([m for m in made if m.proof == "search"]), 0)
        for manifold in made:
            with self.subTest(manifold=manifold):
                again = self.check(manifold)
                ovoid.verify(again)
                self.assertEqual(repr(again.polygon().points.tolist()), repr(manifold.polygon().points.tolist()))

    def test_events(self):
        for event in make_events():
            with self.subTest(event=event):
                ovoid.verify(self.check(event))

    def test_motions(self):
        for motion in make_motions():
            again = self.check(motion)
            self.assertEqual([again.pose(t / 8) for t in range(30)], [motion.pose(t / 8) for t in range(30)])

    def test_others(self):
        smooth = ovoid.smooth(BOX, PILL, None, TURNED, order=2)
        ray = ovoid.cast_ray(BOX, None, (9, 0, 0), (-1, 0, 0))
        for value in (smooth, smooth.outer, BOX.outer, BOX.inner, ray, ovoid.gradient(ovoid.distance(BOX, PILL, None, TURNED)),
                      ovoid.Prepared(BOX, TURNED), BOX, PAIR, SOLID, TURNED):
            with self.subTest(value=value):
                self.check(value)

    def test_bodies(self):
        bodies = ovoid.Bodies([BOX, PAIR, SOLID, BOX], [(0, 0, 0), TURNED, DEEP, (9, 0, 0)])
        bodies.move([(1, 0, 0), TURNED, DEEP, (9, 0, 0)])
        again = pickle.loads(pickle.dumps(bodies))
        couples = [(0, 1), (1, 2), (0, 3)]
        self.assertEqual(ovoid.distance_batch(again, couples).tolist(), ovoid.distance_batch(bodies, couples).tolist())
        self.assertIs(again.shapes[0], again.shapes[3])

    def test_world(self):
        world = ovoid.World(threads=2, enlargement=0.1)
        ids = [world.add(BOX, (3 * i, 0, 0), group=1, mask=1 + i % 2) for i in range(5)]
        world.add(PAIR, DEEP)
        world.set_ignored(ids[0], ids[2])
        world.set_material(ids[3], margin=0.25, friction=0.5)
        again = pickle.loads(pickle.dumps(world))
        self.assertEqual([again.material(i) for i in ids], [world.material(i) for i in ids])
        self.assertEqual(again.ids().tolist(), world.ids().tolist())
        self.assertEqual(again.contacts("distance", 3).items.tolist(), world.contacts("distance", 3).items.tolist())
        self.assertEqual([again.is_pair(a, b) for a in ids for b in ids], [world.is_pair(a, b) for a in ids for b in ids])
        world.remove(ids[1])
        with self.assertRaisesRegex(TypeError, "bodies were removed"):
            pickle.dumps(world)

    def test_processes(self):
        answers = [ovoid.distance(BOX, PILL, None, (4 + i, 0, 0)) for i in range(6)] + [ovoid.distance(SOLID, PAIR, None, TURNED)]
        with multiprocessing.get_context("spawn").Pool(2) as pool:
            for answer, again in zip(answers, pool.map(ask_again, answers)):
                self.assertEqual((again.lower, again.upper), (ask_again(answer).lower, ask_again(answer).upper))
                ovoid.verify(again)


@unittest.skipUnless(ovoid.has_robot, "built without libovoid_robot")
class Robots(unittest.TestCase):
    def make(self):
        joints = [ovoid.Joint("shoulder", "revolute", "base", "upper", TURNED, (0, 0.3, 1), -3, 3, 2),
                  ovoid.Joint("elbow", "continuous", "upper", "lower", DEEP, (0, 0, 2)),
                  ovoid.Joint("finger", "prismatic", "lower", "tip", None, (1, 1, 0), 0.1, 1, 0, "elbow", 0.5, 0.1)]
        return ovoid.Robot(["base", "upper", "lower", "tip"], joints, [("upper", PILL, DEEP), ("lower", PILL, None, "bar")],
                           [("upper", "lower", "Adjacent"), ("base", "tip")], name="arm")

    def test_robot(self):
        arm = self.make()
        self.assertEqual(arm.disabled, (("base", "tip", None), ("upper", "lower", "Adjacent")))
        for again in (pickle.loads(pickle.dumps(arm)), copy.deepcopy(arm)):
            states = [(0.3 * i, 0.7 * i) for i in range(-9, 9)]
            self.assertEqual(again.poses(states).tolist(), arm.poses(states).tolist())
            self.assertEqual(repr((again.joints, again.elements, again.disabled, again.variables)), repr((arm.joints, arm.elements, arm.disabled, arm.variables)))

    def test_states_by_names(self):
        arm = self.make()
        self.assertEqual(arm.default_state(), [0, 0])
        self.assertEqual(arm.q(elbow=0.5), [0, 0.5])
        self.assertEqual(arm.q({"elbow": 0.5}, shoulder=1), [1, 0.5])
        self.assertEqual(arm.q_dict(arm.q(elbow=0.5)), {"shoulder": 0, "elbow": 0.5})
        with self.assertRaisesRegex(ovoid.Error, "the robot has no variable 'wrist': shoulder, elbow"):
            arm.q(wrist=1)
        with self.assertRaisesRegex(ovoid.Error, "the robot has no state 'home': it has none"):
            arm.q("home")
        with self.assertRaisesRegex(ovoid.Error, "has 2 numbers, not 1"):
            arm.q_dict([1])
        arm._set_facts({"states": (("home", "arm", {"elbow": (0.25,)}), ("home", "rest", {"shoulder": (1.5,)}))})
        self.assertEqual(arm.q("home", elbow=2), [1.5, 2])

    def test_refused(self):
        cell = ovoid.Cell(self.make())
        with self.assertRaisesRegex(TypeError, "an ovoid.Cell cannot be pickled or copied: .*make a Cell"):
            pickle.dumps(cell)
        with self.assertRaisesRegex(TypeError, "an ovoid.RobotPath cannot be pickled"):
            copy.copy(cell.find_hit([(0, 0), (0.1, 0.1)]))


class Altered(unittest.TestCase):
    """Bytes that were altered are refused, or are an object that can be used."""

    def use(self, value):
        repr(get_fields(value))
        if isinstance(value, (ovoid.Answer, ovoid.Impact, ovoid.Approach)):
            ovoid.is_proven(value)

    def test_digest(self):
        from ovoid import _pickle
        dice = random.Random(1)
        for value in make_answers()[:3] + make_motions() + make_events()[:2]:
            make, (name, objects, state, digest) = _pickle._reduce_state(value)
            for _ in range(50):
                altered = bytearray(state)
                altered[dice.randrange(len(altered))] ^= 1 << dice.randrange(8)
                with self.assertRaisesRegex(ovoid.Error, "altered, or another version"):
                    make(name, objects, bytes(altered), digest)

    def test_state(self):
        """With a digest that is true: lengths and indices are checked."""
        dice, refused, made = random.Random(2), 0, 0
        for value in make_answers() + make_motions() + make_events():
            objects, state = ovoid._ovoid._get_state(value)
            for i in range(60):
                altered = bytearray(state)
                for _ in range(dice.choice((1, 1, 8))):
                    altered[dice.randrange(len(altered))] = dice.choice((0, 1, 127, 255, dice.randrange(256)))
                if i % 6 == 0:
                    del altered[dice.randrange(len(altered)):]
                try:
                    again = ovoid._ovoid._make_from_state(type(value), objects, bytes(altered))
                    made += 1
                except ovoid.Error:
                    refused += 1
                    continue
                try:
                    self.use(again)
                except (ovoid.Error, IndexError):
                    pass
        self.assertGreater(refused, 500)
        self.assertGreater(made, 500)


class Reprs(unittest.TestCase):
    def test_words(self):
        self.assertEqual(repr(ovoid.Bodies(BOX, [None, (1, 0, 0)])), "<ovoid.Bodies: 2 bodies>")
        self.assertEqual(repr(PAIR), "<ovoid.Compound: 2 parts>")
        self.assertEqual(repr(ovoid.World()), "<ovoid.World: 0 bodies>")
        self.assertEqual(repr(make_motions()[2]), "<ovoid.Motion: begins at (4.0, 0.1, 0.2), ends at (0.0, 0.0, 0.0)>")
        self.assertRegex(repr(ovoid.find_impact(BOX, PILL, None, make_motions()[1])), "^<ovoid.Impact: hit, 0.* <= t <= 0.*>$")
        self.assertRegex(repr(ovoid.find_approach(BOX, PILL, None, TURNED)), "^<ovoid.Approach: separated, .* <= least d <= ")
        self.assertRegex(repr(BOX.outer), "^<ovoid.Ellipsoid: radii ")


if __name__ == "__main__":
    common.main()
