"""Robots. Truth: closed forms of an arm of two bars, the same questions asked of worlds of posed shapes, differences of
distances beside gradients, the proofs' own checks."""

import math
import os
import pickle
import shutil
import tempfile
import threading
import unittest
import warnings

import common
import ovoid
from common import needs_numpy, numpy

SOURCE = os.environ.get("OVOID_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", ".."))
ARM = os.path.join(SOURCE, "tests", "cli", "data", "arm")
BAR = ovoid.Shape.capsule(0.1, 0.5)
ALONG = ovoid.Pose.from_rpy((0.5, 0, 0), (0, math.pi / 2, 0))
BALL = ovoid.Shape.sphere(0.2)


def at(x, y=0, z=0):
    return ovoid.Pose.from_quaternion((x, y, z), wxyz=(1, 0, 0, 0))


def make_arm(**options):
    """Two bars of length 1 in the plane z = 0, on joints about z; their ends are cos and sin of the angles."""
    joints = [ovoid.Joint("shoulder", "revolute", "base", "upper", axis=(0, 0, 1), lower=-3, upper=3, velocity=2),
              ovoid.Joint("elbow", "continuous", "upper", "lower", at(1), (0, 0, 2))]
    elements = [("upper", BAR, ALONG), ovoid.Element("lower", BAR, ALONG, "bar")]
    return ovoid.Robot(["base", "upper", "lower"], joints, elements, [("upper", "lower")], **options)


def get_end(q):
    return math.cos(q[0]) + math.cos(q[0] + q[1]), math.sin(q[0]) + math.sin(q[0] + q[1])


def make_states(count):
    """States over all directions, the same in every run."""
    return [(math.remainder(1.7 * i, 5.8), math.remainder(2.3 * i, 6)) for i in range(count)]


def rows(array):
    """Records as dicts, of NumPy's arrays too."""
    if isinstance(array, ovoid.Array):
        return array.tolist()
    return [dict(zip(array.dtype.names, record)) for record in array.tolist()]


@unittest.skipUnless(ovoid.has_robot, "built without libovoid_robot")
class Model(unittest.TestCase):
    def test_description(self):
        arm = make_arm(name="arm")
        self.assertEqual((arm.name, arm.root, arm.links), ("arm", "base", ("base", "upper", "lower")))
        self.assertEqual([joint.type for joint in arm.joints], ["revolute", "continuous"])
        self.assertEqual([variable.name for variable in arm.variables], ["shoulder", "elbow"])
        self.assertEqual((arm.lower.tolist(), arm.upper.tolist()), ([-3, -math.inf], [3, math.inf]))
        self.assertEqual(arm.variables[0].velocity, 2)
        self.assertEqual(arm.disabled, (("upper", "lower", None),))
        self.assertIs(arm.elements[1].shape, BAR)
        self.assertEqual(arm.elements[1].name, "bar")
        self.assertEqual((arm.find_link("lower"), arm.find_joint("elbow"), arm.parent_joint("lower")), (2, 1, 1))
        self.assertEqual((arm.parent_joint("base"), arm.joint_variable("elbow")), (None, 1))
        self.assertFalse(arm.is_rigid_pair("upper", 2))
        again = ovoid.Robot(arm.links, arm.joints, arm.elements, [pair[:2] for pair in arm.disabled])
        self.assertEqual(again.joints, arm.joints)
        self.assertEqual((arm.groups, arm.meshes, arm.fixed_mimics), ((), (), 0))

    def test_mimic(self):
        joints = [ovoid.Joint("b", "revolute", "a", "b", axis=(0, 0, 1), mimic="c", multiplier=2, offset=0.5),
                  ovoid.Joint("c", "revolute", "a", "c", axis=(0, 0, 1), lower=-1, upper=1)]
        robot = ovoid.Robot(["a", "b", "c"], joints)
        self.assertEqual((robot.joints[0].mimic, len(robot.variables), robot.joint_variable("b")), ("c", 1, 0))
        self.assertAlmostEqual(robot.poses([0.3]).tolist()[1][0][0], math.cos(1.1), delta=1e-14)

    def test_poses(self):
        arm = make_arm()
        states = make_states(40)
        many = arm.poses(states).tolist()
        for q, poses in zip(states, many):
            self.assertEqual(poses, arm.poses(q).tolist())
            seven = arm.poses(q, order="xyzw").tolist()
            self.assertEqual([row[:3] for row in seven], [[row[3] for row in matrix[:3]] for matrix in poses])
            turned = ovoid.Pose.from_quaternion(seven[2][:3], xyzw=seven[2][3:])
            x, y = get_end(q)
            for found in (turned.apply((1, 0, 0)), ovoid.Pose(poses[2]).apply((1, 0, 0))):
                self.assertLess(math.dist(found.tolist(), (x, y, 0)), 1e-13)
            wxyz = arm.poses(q, order="wxyz").tolist()
            self.assertEqual([row[3:4] for row in wxyz], [row[6:] for row in seven])
        self.assertLess(max(max(row) for row in arm.pose_errors(states[1]).tolist()), 1e-13)

    def test_refusals(self):
        arm = make_arm()
        arm.validate_limits([3, 99])
        with self.assertRaises(ovoid.Error) as raised:
            arm.validate_limits([3.1, 0])
        self.assertEqual((raised.exception.code, raised.exception.place), (ovoid.Code.RANGE, 0))
        self.assertIn("shoulder", str(raised.exception))
        arm.validate_limits([3.1, 0], slack=0.2)
        for bad in ([1], [1, 2, 3], [[[1, 2]]], "12", None, [math.nan, 0]):
            with self.assertRaises((TypeError, ovoid.Error)):
                arm.poses(bad)
        joint = ovoid.Joint("j", "revolute", "a", "b")
        for given in ((["a"], [joint]), (["a", "b"], [joint._replace(type="round")]), (["a", "b"], [joint, joint]),
                      (["a", "b"], [joint._replace(mimic="k")]), (["a", "b"], ["j"]), (["a", 1], [joint]), ([], []),
                      (["a", "b"], [joint], [("c", BALL)]), (["a", "b"], [joint], [("a", "ball")]),
                      (["a", "b"], [joint], [], [("a", "z")]), (["a", "b\0"], [joint])):
            with self.assertRaises((TypeError, ValueError), msg=given):
                ovoid.Robot(*given)


@unittest.skipUnless(ovoid.has_robot, "built without libovoid_robot")
class Cells(unittest.TestCase):
    def setUp(self):
        self.arm = make_arm()
        self.cell = ovoid.Cell(self.arm)
        self.ball = self.cell.add(BALL, at(1.5))

    def test_states(self):
        # The end of the stretched arm goes through the ball; folded back it does not.
        found = self.cell.collide([0, 0])
        self.assertEqual(found.status, ovoid.RobotStatus.HIT)
        self.assertEqual((found.a.link, found.a.element, found.b.body), (2, 1, self.ball))
        self.assertLess(found.upper, 0)
        free = self.cell.collide([2, 0])
        self.assertEqual((free.status, free.a, free.code), (ovoid.RobotStatus.FREE, None, None))
        refused = self.cell.collide([4, 0])
        self.assertEqual((refused.status, refused.code, refused.variable), (ovoid.RobotStatus.REFUSED, ovoid.Code.RANGE, 0))
        self.assertEqual(self.cell.collide([4, 0], limit_slack=2).status, ovoid.RobotStatus.FREE)
        self.assertEqual(self.cell.collide([0, 0], without_obstacles=True).status, ovoid.RobotStatus.UNDECIDED)
        with self.assertRaises(ovoid.Error):
            self.cell.collide([0, 0], margin=-1)

    def test_as_world(self):
        world = ovoid.World()
        world.add(BALL, at(1.5))
        for q in make_states(100):
            poses = [ovoid.Pose(matrix) @ ALONG for matrix in self.arm.poses(q).tolist()[1:]]
            hit = world.find_any_to([BAR, BAR], poses)
            self.assertEqual(self.cell.collide(q).status == ovoid.RobotStatus.FREE, hit is None, q)
            pairs = [ovoid.distance(BAR, BALL, pose, at(1.5)) for pose in poses]
            nearest, gradients = self.cell.nearest(q)
            least = min(pair.lower for pair in pairs)
            if least > 0:
                self.assertAlmostEqual(rows(nearest)[0]["lower"], least, delta=1e-8)

    def test_batch(self):
        states = make_states(700)
        threads = [self.cell.collide_batch(states, threads=count) for count in (1, 3)]
        self.assertEqual(*(bytes(memoryview(array).cast("B")) for array in threads))
        self.cell.reset()
        for q, row in list(zip(states, rows(threads[0])))[:256]:
            single = self.cell.collide(q)
            self.assertEqual((row["status"], row["link_a"] if single.a else None),
                             (single.status, single.a.link if single.a else None))
        out = ovoid.zeros("states", 700)
        seen = []
        self.assertIs(self.cell.collide_batch(states, out=out, progress=lambda *at: seen.append(at)), out)
        self.assertEqual(bytes(memoryview(out).cast("B")), bytes(memoryview(threads[0]).cast("B")))
        self.assertEqual(seen[-1], (700, 700))
        with self.assertRaises(ZeroDivisionError):
            self.cell.collide_batch(states, progress=lambda *at: 1 / 0)
        for bad in ({"threads": 0}, {"out": ovoid.zeros("states", 3)}, {"out": ovoid.zeros("proofs", 700)}, {"progress": 3}):
            with self.assertRaises((TypeError, ovoid.Error)):
                self.cell.collide_batch(states, **bad)
        self.assertEqual(len(self.cell.collide_batch([])), 0)

    def test_near(self):
        self.cell.add(BALL, at(-1.5))
        near, gradients = self.cell.near([math.pi / 2, 0.5], 5)
        plain = self.cell.near([math.pi / 2, 0.5], 5, without_depths=True)[0]
        self.assertEqual(len(plain), len(near))
        self.assertEqual(len(near), 4)
        self.assertEqual([row["lower"] for row in rows(near)], sorted(row["lower"] for row in rows(near)))
        self.assertEqual(len(self.cell.near([math.pi / 2, 0.5], 0.1)[0]), 0)
        # Differences of distances beside the gradients.
        for q in make_states(12):
            q = list(q)
            nearest, gradient = self.cell.nearest(q)
            if not rows(nearest)[0]["has_gradient"]:
                continue
            for k in range(2):
                step = 1e-6
                values = []
                for sign in (1, -1):
                    moved = list(q)
                    moved[k] += sign * step
                    values.append(rows(self.cell.nearest(moved, limit_slack=1)[0])[0]["lower"])
                self.assertAlmostEqual((values[0] - values[1]) / (2 * step), gradient.tolist()[0][k], delta=1e-3)

    def test_nearest_batch(self):
        states = make_states(300)
        many, gradients = self.cell.nearest_batch(states)
        self.cell.reset()
        for q, row, slope in zip(states[:256], rows(many), gradients.tolist()):
            single, gradient = self.cell.nearest(q)
            self.assertEqual(list(map(str, row.values())), list(map(str, rows(single)[0].values())))
            self.assertEqual(slope, gradient.tolist()[0])
        # A block begins as if nothing was asked before.
        tail = self.cell.nearest_batch(states[256:])[0]
        self.assertEqual([list(map(str, row.values())) for row in rows(tail)], [list(map(str, row.values())) for row in rows(many)[256:]])
        # Of two balls as near as each other the one is named that a new cell names, whatever the block before ended with.
        cell = ovoid.Cell(self.arm)
        for y in (0.8, -0.8):
            cell.add(BALL, at(0.5, y))
        for before in (0.5, -0.5):
            cell.reset()
            pairs = rows(cell.nearest_batch([(before, 0)] * 256 + [(0, 0)] * 3)[0])
            cell.reset()
            self.assertEqual([list(map(str, row.values())) for row in pairs[256:]],
                             [list(map(str, row.values())) for row in rows(cell.nearest_batch([(0, 0)] * 3)[0])])
            self.assertNotEqual(pairs[0]["body_b"], 0)
        far = rows(self.cell.nearest_batch([(2, 0)], margin=0.01)[0])[0]
        self.assertEqual((far["lower"], far["upper"], far["link_a"], far["status"]), (0.01, math.inf, 2**32 - 1, 1))
        with self.assertRaises(ovoid.Error) as raised:
            self.cell.nearest_batch(states[:5] + [(9, 9)])
        self.assertEqual(raised.exception.place, 5)

    def test_changes(self):
        cell = self.cell
        free = [2, 0]
        block = cell.add(BALL, at(*get_end(free)))
        self.assertEqual(cell.collide(free).status, ovoid.RobotStatus.HIT)
        cell.allow_body(block, "lower")
        self.assertEqual(cell.collide(free).status, ovoid.RobotStatus.FREE)
        cell.allow_body(block, "lower", False)
        cell.move(block, at(0, 0, 9))
        self.assertEqual(cell.collide(free).status, ovoid.RobotStatus.FREE)
        cell.move(block, at(*get_end(free)))
        cell.remove(block)
        self.assertEqual((cell.collide(free).status, list(cell.bodies)), (ovoid.RobotStatus.FREE, [self.ball]))
        # A ball in the hand meets the ball on the table where the hand alone does not.
        nearly = [0, 1.2]
        self.assertEqual(cell.collide(nearly).status, ovoid.RobotStatus.FREE)
        held = cell.attach("lower", ovoid.Shape.sphere(0.8), at(1), ["upper"])
        self.assertEqual(cell.collide(nearly).status, ovoid.RobotStatus.HIT)
        cell.remove(held)
        cell.set_padding("lower", 0.5)
        self.assertEqual((cell.get_padding("lower"), cell.get_padding("upper")), (0.5, 0))
        cell.allow("base", "lower")
        cell.allow_body(block := cell.add(ovoid.Shape.box([1, 1, 1]), at(0, 0, 9)), "lower")
        self.assertEqual([cell.is_allowed("base", "lower"), cell.is_body_allowed(block, "lower"), cell.is_body_allowed(block, "upper")],
                         [True, True, False])
        cell.allow("base", "lower", False)
        self.assertFalse(cell.is_allowed("base", "lower"))
        cell.remove(block)
        self.assertEqual(cell.collide(nearly).status, ovoid.RobotStatus.HIT)
        for call in (lambda: cell.remove(held), lambda: cell.move(7, None), lambda: cell.set_padding("lower", -1),
                     lambda: cell.allow("upper", "nowhere"), lambda: cell.allow(9, 1), lambda: cell.add("ball"),
                     lambda: cell.attach("lower", BALL, None, ["x"]), lambda: ovoid.Cell(BALL), lambda: cell.pair(10**6)):
            with self.assertRaises((TypeError, ovoid.Error)):
                call()
        self.assertGreater(cell.pair_count, 1)
        self.assertEqual([side.body for side in cell.pair(cell.pair_count - 1)][0], 0)

    def test_threads(self):
        """Queries may overlap; a change meanwhile raises or is made between them."""
        states, wrong = make_states(3000), []
        expected = bytes(memoryview(self.cell.collide_batch(states)).cast("B"))

        def ask():
            for _ in range(5):
                if bytes(memoryview(self.cell.collide_batch(states)).cast("B")) != expected:
                    wrong.append(1)

        threads = [threading.Thread(target=ask) for _ in range(3)]
        for thread in threads:
            thread.start()
        for _ in range(20):
            try:
                self.cell.set_padding("lower", 0)
            except RuntimeError:
                pass
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_path(self):
        free = self.cell.find_hit([[0.5, 0], [2, 1], [1, -1]])
        self.assertEqual((free.status, free.hit, free.hit_at, free.refused), (ovoid.RobotStatus.FREE, None, math.inf, None))
        ovoid.verify(free)
        self.assertGreater(len(free.steps), 0)
        # The ball's rim is met by the bar where sin(angle) * 1.5 is the sum of the radii.
        hit = self.cell.find_hit([[1, 0], [-1, 0]])
        angle = math.asin(0.3 / 1.5)
        self.assertEqual(hit.status, ovoid.RobotStatus.HIT)
        self.assertLess(abs(hit.free_until - (1 - angle) / 2), 2e-6)
        self.assertLessEqual(hit.free_until, hit.hit_at)
        self.assertEqual(hit.hit.b.body, self.ball)
        ovoid.verify(hit)
        self.assertTrue(ovoid.is_proven(hit))
        many = self.cell.find_hit([[1.5 - 0.003 * i, 0.1 * i] for i in range(400)])
        self.assertGreater(len(many.steps), 256)
        ovoid.verify(many)
        refused = self.cell.find_hit([[1, 0], [9, 0]])
        self.assertEqual((refused.status, refused.refused), (ovoid.RobotStatus.REFUSED, 0))
        self.cell.move(self.ball, at(9))
        for path in (hit, free):
            with self.assertRaisesRegex(ovoid.Error, "the cell has changed"):
                ovoid.verify(path)
        for bad in ([], [[1]], [1, 2], "x"):
            with self.assertRaises((TypeError, ovoid.Error)):
                self.cell.find_hit(bad)

    def test_matrix(self):
        robot = ovoid.Robot(self.arm.links, self.arm.joints, self.arm.elements)
        (pair,) = robot.compute_matrix(samples=50, budget=5000)
        # The bars share the elbow in all states.
        self.assertEqual((pair.a, pair.b, pair.touch, pair.hits), ("upper", "lower", ovoid.Touch.ALWAYS, 50))
        self.assertEqual((pair.is_neighbour, pair.reason, pair.free, len(pair.hit)), (True, "Adjacent", None, 2))

    def test_spheres(self):
        cube = ovoid.Robot(["cube"], [], [("cube", ovoid.Shape.box((0.1, 0.1, 0.1)))])
        spheres, depth = cube.cover_spheres("cube", 1, rounds=2)
        self.assertLessEqual(depth[1], 0)
        self.assertAlmostEqual(spheres.tolist()[0][3], 0.1 * math.sqrt(3), delta=1e-9)
        audit = cube.audit_spheres(0, spheres, volume_cells=64, tolerance=1e-3)
        self.assertTrue(audit.link[0] <= 0.008 <= audit.link[1])
        self.assertTrue(audit.uncovered[0] == 0 and audit.excess[1] > 0 and audit.cells > 0)
        # The ends of the bar are half its length from the ball in its middle.
        one = self.arm.audit_spheres("upper", [[0.5, 0, 0, 0.1]], without_volumes=True, tolerance=1e-3)
        self.assertTrue(one.depth[0] <= 0.5 + 1e-12 and one.depth[1] >= 0.5 - 1e-12, one.depth)
        self.assertLess(one.depth[1] - one.depth[0], 2e-3)
        with self.assertRaises(ovoid.Error):
            self.arm.audit_spheres("upper", [[0, 0, 0, -1]])
        with self.assertRaises(ovoid.Error):
            self.arm.cover_spheres("upper", 0)

    @needs_numpy
    def test_arrays(self):
        states = numpy.array(make_states(64))
        expected = self.cell.collide_batch(states)
        for given in (numpy.asfortranarray(states), numpy.repeat(states, 2, 0)[::2], states[::-1][::-1]):
            self.assertTrue((self.cell.collide_batch(given) == expected).all())
        self.assertEqual(self.arm.poses(states).shape, (64, 3, 4, 4))
        self.assertEqual(self.arm.poses(states, order="wxyz").shape, (64, 3, 7))
        self.assertEqual(self.arm.poses(states.astype("f4")[0]).shape, (3, 4, 4))
        for bad in (states.astype(complex), states.astype(">f8"), states[:, :1], states * numpy.nan):
            try:
                statuses = self.cell.collide_batch(bad)["status"]
            except (TypeError, ovoid.Error):
                continue
            self.assertTrue((statuses == ovoid.RobotStatus.REFUSED).all())


@unittest.skipUnless(ovoid.has_robot, "built without libovoid_robot")
class Names(unittest.TestCase):
    def test_sides(self):
        cell = ovoid.Cell(make_arm())
        first = cell.add(BALL, (0, 1.5, 0), name="ball")
        hit = cell.collide((1.5, 0))
        self.assertEqual((hit.a.name, hit.b.name), ("lower", "ball"))
        # Of one name they are numbered; what a link holds stands behind it, and its own element then too.
        second = cell.add(BALL, (5, 5, 0), name="ball")
        cell.move(second, (0, -1.5, 0))
        self.assertEqual([cell.collide((angle, 0)).b.name for angle in (1.5, -1.5)], ["ball[0]", "ball[1]"])
        held = cell.attach("lower", BALL, (1, 0, 0))
        self.assertEqual(cell.names, {first: "ball", second: "ball", held: f"body {held}"})
        near, _ = cell.near((1.2, 0), 0.5)
        self.assertEqual(set(cell.pair_names(near)), {("lower[bar]", "ball[0]"), ("upper", "ball[0]"), (f"lower[body {held}]", "ball[0]")})
        self.assertEqual(cell.pair_names(cell.collide_batch([(0.3, 0.4), (1.5, 0), (9, 9)])), [None, ("lower[bar]", "ball[0]"), None])
        self.assertIn(("upper", "ball[0]"), [(a.name, b.name) for a, b in map(cell.pair, range(cell.pair_count))])
        cell.remove(first)
        self.assertEqual(cell.collide((-1.5, 0)).b.name, "ball")
        for call in (lambda: cell.add(BALL, name=3), lambda: cell.attach("upper", BALL, name=b"x"), lambda: cell.pair_names(ovoid.zeros("verdicts", 1)),
                     lambda: cell.pair_names(3)):
            with self.assertRaises(TypeError):
                call()
        self.assertEqual(len(cell.names), 2)

    def test_solids(self):
        """A ball in the notch of an L is free of it; a robot that is pickled keeps its solids."""
        corner = ovoid.Solid.from_triangles(*common.make_corner())
        joint = ovoid.Joint("j", "prismatic", "base", "tip", axis=(1, 0, 0), lower=-9, upper=9)
        robot = ovoid.Robot(["base", "tip"], [joint], [("tip", corner)])
        hulls = ovoid.Robot(["base", "tip"], [joint], [("tip", robot.elements[0].shape)])
        statuses = []
        for one in robot, pickle.loads(pickle.dumps(robot)), hulls:
            cell = ovoid.Cell(one)
            cell.add(BALL, (1.5, 1.5, 0.5))
            statuses.append(str(cell.collide((0,)).status))
        self.assertEqual(statuses, ["free", "free", "hit"])

    def test_states(self):
        arm = make_arm()
        cell = ovoid.Cell(arm)
        cell.add(BALL, (0, 1.5, 0))
        bent = {"elbow": 0.5}
        self.assertEqual(arm.poses(bent).tolist(), arm.poses((0, 0.5)).tolist())
        self.assertEqual(arm.poses([bent, (1, 2)]).tolist(), arm.poses([(0, 0.5), (1, 2)]).tolist())
        self.assertEqual(cell.collide({"shoulder": 1.5}), cell.collide((1.5, 0)))
        self.assertEqual(bytes(memoryview(cell.collide_batch([bent, {"shoulder": 1.5}])).cast("B")),
                         bytes(memoryview(cell.collide_batch([(0, 0.5), (1.5, 0)])).cast("B")))
        self.assertEqual(cell.find_hit([bent, {"shoulder": 1.5}]).hit_at, cell.find_hit([(0, 0.5), (1.5, 0)]).hit_at)
        for call in (lambda: cell.collide({"elbo": 1}), lambda: cell.collide("ready"), lambda: cell.find_hit(["ready", (0, 0)])):
            with self.assertRaisesRegex(ovoid.Error, "elbo|ready"):
                call()


@unittest.skipUnless(ovoid.has_robot and ovoid.has_io, "built without readers of robots")
class Files(unittest.TestCase):
    def read(self, *more, **options):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            robot = ovoid.Robot.read(os.path.join(ARM, "arm.urdf"), *more, packages={"arm": ARM}, **options)
        return robot, [str(warning.message) for warning in told]

    def test_robot(self):
        robot, told = self.read(os.path.join(ARM, "arm.srdf"), fixed_base=False)
        self.assertEqual((robot.root, len(robot.variables), len(told)), ("world", 6, 1))
        self.assertIn("camera", told[0])
        self.assertEqual([variable.name for variable in robot.variables][3:], ["floor/x", "floor/y", "floor/angle"])
        self.assertEqual(robot.groups[0], ("reach", ("shoulder", "wrist"), ("base", "upper", "hand")))
        self.assertEqual(robot.states, (("up", "reach", {"shoulder": (0,), "wrist": (1.5,)}),))
        self.assertEqual(robot.end_effectors, (("fingers", "hand", "fingers"),))
        self.assertEqual((robot.passive, robot.spheres), (("right_slide",), (("upper", (0, 0, 0.5), 0.6),)))
        self.assertEqual(robot.meshes[0]["kind"], "solid")
        self.assertIn(("link/inertial", 1), robot.ignored)
        fixed = self.read(os.path.join(ARM, "arm.srdf"))[0]
        self.assertEqual((fixed.root, len(fixed.variables)), ("base", 3))
        # Its own shapes outlive it.
        shape = self.read()[0].elements[2].shape
        self.assertAlmostEqual(shape.volume, 0.007, delta=1e-9)
        self.assertEqual(len(self.read(parts=True)[0].meshes), 1)

    def test_solids_of_links(self):
        """A robot of solids stays one of solids where it is made again of its parts."""
        robot = self.read(os.path.join(ARM, "arm.srdf"))[0]
        hand = robot.elements[2]
        self.assertTrue(hand.solid.is_closed)
        self.assertEqual(robot.elements[0].solid, None)
        for again in (pickle.loads(pickle.dumps(robot)), ovoid.Robot(robot.links, robot.joints, robot.elements, robot.disabled),
                      ovoid.Robot(robot.links, robot.joints, [(e.link, e.solid or e.shape, e.pose, e.name) for e in robot.elements])):
            element = again.elements[2]
            self.assertEqual(element.solid.faces.tolist(), hand.solid.faces.tolist())
            self.assertAlmostEqual(element.shape.volume, hand.shape.volume, delta=1e-12)
        for bad in (("hand", 3), ("hand", hand.shape, None, None, 3), ("hand", hand.solid, None, None, hand.shape), ("hand", None, None, None, hand.shape)):
            with self.assertRaisesRegex(TypeError, "a Shape or a Solid is wanted"):
                ovoid.Robot(robot.links, robot.joints, [bad])

    def test_names(self):
        """Sides are called as the tool calls them: transcripts/robot_check.txt."""
        cell = ovoid.Cell(self.read(os.path.join(ARM, "arm.srdf"), parts=True)[0])
        cell.read(os.path.join(ARM, "cell.yaml"))
        self.assertEqual(list(cell.names.values()), ["table", "pillar"])
        hit = cell.collide({"shoulder": 1.4})
        self.assertEqual((hit.a.name, hit.b.name), ("upper", "table"))
        self.assertEqual(cell.find_hit(["up", {"shoulder": 1.4}]).hit.b.name, "table")
        self.assertEqual(cell.pair_names(cell.near("up", 0.5)[0])[0], ("base", "table"))

    def test_trouble(self):
        with self.assertRaises(ovoid.Error) as raised:
            ovoid.Robot.read(os.path.join(ARM, "upside_down.urdf"))
        self.assertIn("upside_down.urdf:", str(raised.exception))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(UserWarning):
                ovoid.Robot.read(os.path.join(ARM, "arm.urdf"), os.path.join(ARM, "arm.srdf"), packages={"arm": ARM})
        for call in (lambda: ovoid.Robot.read("absent.urdf"), lambda: ovoid.Robot.read(3), lambda: ovoid.read_obstacles("absent.yaml"),
                     lambda: ovoid.Robot.read(os.path.join(ARM, "arm.urdf"), packages=3), lambda: ovoid.find_problems(ARM),
                     lambda: ovoid.Robot.read(os.path.join(ARM, "arm.urdf"), packages={"arm": 3}),
                     lambda: ovoid.read_motion_request(os.path.join(ARM, "cell.yaml") + "x")):
            with self.assertRaises((TypeError, ovoid.Error)):
                call()

    def test_scene(self):
        cell = ovoid.Cell(self.read()[0])
        ids = cell.read(os.path.join(ARM, "cell.yaml"))
        self.assertEqual([name for name, _ in ids], ["table", "pillar"])
        obstacles = ovoid.read_obstacles(os.path.join(ARM, "cell.yaml"))
        self.assertEqual([one.shape.volume for one in obstacles], [cell.bodies[key].volume for _, key in ids])
        self.assertEqual(obstacles[0].pose.xyz, (1, 0, 0.4))
        self.assertEqual(cell.collide([1.4, 0, 0], without_self=True).status, ovoid.RobotStatus.HIT)
        self.assertEqual(cell.collide([-1, 0, 0], without_self=True).status, ovoid.RobotStatus.FREE)

    def test_kinds(self):
        # A box in the notch of an L: free of the mesh, in its hull; the tool says the same.
        slide = ('<robot name="r"><link name="base"/><link name="tip"><collision><origin xyz="1.2 1.2 0.5"/><geometry><box size="0.1 0.1 0.1"/>'
                 '</geometry></collision></link><joint name="j" type="prismatic"><parent link="base"/><child link="tip"/><axis xyz="1 0 0"/>'
                 '<limit lower="-5" upper="5"/></joint></robot>')
        faces = ["354", "305", "310", "321", "9AB", "9B6", "967", "978", "017", "076", "128", "187", "239", "298", "34A", "3A9", "45B", "4BA", "506", "56B"]
        corners = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
        mesh = {"triangles": [[int(c, 16) for c in face] for face in faces], "vertices": [[x, y, z] for z in (0, 1) for x, y in corners]}
        held = ('link_padding: [{link_name: tip, padding: 0.01}]\nrobot_state: {attached_collision_objects: [{link_name: tip, object: {id: held, '
                'header: {frame_id: tip}, primitives: [{type: box, dimensions: [9, 0.1, 0.1]}]}}]}\n')
        with tempfile.TemporaryDirectory() as folder:
            urdf, scene, other = (os.path.join(folder, name) for name in ("r.urdf", "s.yaml", "t.yaml"))
            text = "world: {collision_objects: [{id: L, meshes: [%s]}]}\n" % mesh
            for path, content in ((urdf, slide), (scene, text), (other, held + text)):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(content)
            robot = ovoid.Robot.read(urdf)

            def ask(path, robot=robot, **how):
                cell = ovoid.Cell(robot)
                cell.read(path, **how)
                return cell.collide((0,)).status
            free, hit = ovoid.RobotStatus.FREE, ovoid.RobotStatus.HIT
            self.assertEqual((ask(scene), ask(scene, solids=False), ask(other)), (free, hit, hit))
            self.assertEqual((ask(scene, paddings={None: 0.1}), ask(scene, paddings={"tip": 0.2}), ask(scene, paddings={None: 9, "tip": 0})), (free, hit, free))
            self.assertEqual(ask(scene, ovoid.Robot.read(urdf, scales={"tip": 5.0})), hit)
            with self.assertRaises(ValueError):
                ovoid.Robot.read(urdf, scales={"tip": 0})
            one = ovoid.read_obstacles(other)
            self.assertEqual([(o.name, o.frame, o.link, o.solid is None) for o in one], [("L", None, None, False), ("held", "tip", "tip", True)])
            self.assertIsNone(ovoid.read_obstacles(scene, solids=False)[0].solid)
            cell = ovoid.Cell(robot)
            (name, key), = cell.read(scene)
            self.assertIsInstance(cell.bodies[key], ovoid.Solid)
            empty = ovoid.Cell(robot).collide((0,))
            self.assertEqual((empty.status, empty.code, empty.a), (ovoid.RobotStatus.UNDECIDED, ovoid.Code.EMPTY, None))

    def test_problems(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(os.path.join(ARM, "cell.yaml"), os.path.join(folder, "scene0001.yaml"))
            with open(os.path.join(folder, "request0001.yaml"), "w", encoding="utf-8") as file:
                file.write("start_state: {joint_state: {name: [a, b], position: [1, -2.5e-1]}}\ngroup_name: arm\n"
                           "goal_constraints: [{joint_constraints: [{joint_name: b, position: 3}]}]\n")
            ((name, scene, request),) = ovoid.find_problems(folder)
            self.assertEqual(name, "0001")
            self.assertEqual(len(ovoid.read_obstacles(scene)), 2)
            moved = os.path.join(folder, "moved.json")
            with open(moved, "w", encoding="utf-8") as file:
                file.write('{"trajectory_start": {"joint_state": {"name": ["wrist"], "position": [0.5]}}, "trajectory": '
                           '{"joint_trajectory": {"joint_names": ["shoulder"], "points": [{"positions": [1]}]}}}')
            self.assertEqual(ovoid.read_trajectory(moved), ({"wrist": 0.5}, [{"wrist": 0.5, "shoulder": 1.0}], None))
            with open(moved, "w", encoding="utf-8") as file:
                file.write('{"joint_names": ["a"], "points": [{"positions": [1], "time_from_start": {"secs": 1, "nsecs": 5e8}}]}')
            self.assertEqual(ovoid.read_trajectory(moved).times, [1.5])
            self.assertRaises(ovoid.Error, ovoid.read_trajectory, scene)
            found = ovoid.read_motion_request(request)
            self.assertEqual(found, ("arm", {"a": 1, "b": -0.25}, [{"b": 3}]))
            with open(request, "w", encoding="utf-8") as file:
                file.write("start_state: {joint_state: {name: [a], position: [1]}}\ngoal_constraints: [{joint_constraints: [{joint_name: b, position: 3}]}, {joint_constraints: []}]\n")
            with self.assertRaisesRegex(ovoid.Error, "request0001.yaml:2: a goal without joint_constraints") as trouble:
                ovoid.read_motion_request(request)
            self.assertEqual(trouble.exception.place, 2)


if __name__ == "__main__":
    common.main()
