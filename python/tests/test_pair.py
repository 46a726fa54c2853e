"""Shapes, poses and queries of a pair. Truth: closed forms of boxes and spheres, the library's own check of each proof, and
what was written is what is read."""

import copy
import math
import os
import pickle
import tempfile
import unittest

import common
import ovoid
from common import needs_numpy, numpy

BOX = ovoid.Shape.box((1, 2, 3))
BALL = ovoid.Shape.sphere(0.5)


def at(x, y=0, z=0):
    return ovoid.Pose.from_quaternion((x, y, z), wxyz=(1, 0, 0, 0))


class Shapes(unittest.TestCase):
    def test_lean(self):
        points = [[math.sin((3 * i + k) ** 2) for k in range(3)] for i in range(100)]
        lean, full = (ovoid.Shape.from_points(points, inner=inner) for inner in ("lean", "maximum"))
        self.assertTrue(lean.is_lean and not full.is_lean and ovoid.Shape.from_bytes(lean.to_bytes()).is_lean)
        self.assertTrue(0.5 * full.inner.volume < lean.inner.volume < full.inner.volume)
        self.assertEqual(lean.inner.gap, math.inf)
        for question in (ovoid.collide, ovoid.distance, ovoid.depth):
            for x in (0.5, 4):
                a, b = (question(s, s, None, at(x)) for s in (lean, full))
                self.assertEqual(a.status, b.status)
                self.assertTrue(a.lower <= b.upper and b.lower <= a.upper)
                ovoid.verify(a)

    def test_box(self):
        self.assertEqual(sorted(map(tuple, BOX.vertices.tolist())),
                         sorted((x, y, z) for x in (-1, 1) for y in (-2, 2) for z in (-3, 3)))
        self.assertEqual((BOX.volume, BOX.area, BOX.rank, BOX.radius), (48, 88, 3, 0))
        self.assertEqual(BOX.bounds, ((-1, -2, -3), (1, 2, 3)))
        self.assertEqual(len(BOX.faces), 12)
        # Of a box the ellipsoids are known: radii sqrt(3) times the half sizes, and the half sizes.
        for radius, half in zip(BOX.outer.radii, (3, 2, 1)):
            self.assertAlmostEqual(radius, math.sqrt(3) * half, delta=1e-5)
        for radius, half in zip(BOX.inner.radii, (3, 2, 1)):
            self.assertAlmostEqual(radius, half, delta=1e-5)

    def test_far_vertices_are_the_users(self):
        # The body frame moves; what is shown must not.
        points = [[1e6 + x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        shape = ovoid.Shape.from_points(points)
        self.assertEqual(sorted(shape.vertices.tolist()), sorted(points))
        self.assertAlmostEqual(shape.centroid[0], 1e6 + 0.5)
        self.assertAlmostEqual(shape.outer.center[0], 1e6 + 0.5, delta=1e-5)
        self.assertEqual(shape.bounds[0][0], 1e6)

    def test_constructors(self):
        self.assertEqual(ovoid.Shape.capsule(0.5, 2).radius, 0.5)
        self.assertEqual(ovoid.Shape.sphere(1, rounding=0.25).radius, 1.25)
        self.assertGreater(ovoid.Shape.cylinder(1, 1).allowance[0], 0)
        self.assertEqual(len(ovoid.Shape.prism(1, 1, 5).vertices), 10)
        self.assertEqual(len(ovoid.Shape.pyramid(1, 1, 5).vertices), 6)
        self.assertEqual(ovoid.Shape.box((1, 1, 1), allowance=(0.25, 0.125)).allowance, (0.25, 0.125))

    def test_ellipsoid(self):
        body = ovoid.Shape.ellipsoid((1, 0.5, 0.25))
        self.assertEqual(body.round, ("ellipsoid", 1, 0.5, 0.25))
        self.assertEqual(ovoid.Shape.from_bytes(body.to_bytes()).round, body.round)
        self.assertEqual(len(ovoid.Shape.ellipsoid((1, 1, 1), 0.01).vertices), 402)
        table = ovoid.Shape.box((2, 2, 0.25))
        for gap, status in ((1e-7, "SEPARATED"), (-1e-7, "OVERLAPPING")):
            answer = ovoid.depth(table, body, (0, 0, -0.25), (0.5, 0.2, 0.25 + gap))
            self.assertEqual(answer.status.name, status)
            self.assertLess(answer.upper - answer.lower, 1e-8)
        self.assertIsNone(ovoid.Shape.ellipsoid((1, 1, 1), allowance=(0.1, 0)).round)

    def test_allowance_axis(self):
        table = ovoid.Shape.box((2, 2, 0.25))
        for post in (ovoid.Shape.cylinder(0.5, 1), ovoid.Shape.cone(0.5, 1)):
            self.assertEqual(post.allowance_axis, (0, 0, 1))
            self.assertIn(post.round[0], ("cylinder", "cone"))
            self.assertEqual(ovoid.Shape.from_bytes(post.to_bytes()).round, post.round)
            for gap, status in ((0, "TOUCHING"), (1e-6, "SEPARATED"), (-1e-6, "OVERLAPPING")):
                answer = ovoid.collide(table, post, (0, 0, -0.25), (0.5, 0.2, 1 + gap))
                self.assertEqual(answer.status.name, status)
        self.assertIsNone(table.allowance_axis)
        other = ovoid.Shape.cylinder(0.5, 1, allowance=(0.1, 0))
        self.assertIsNone(other.allowance_axis)
        self.assertIsNone(other.round)
        slab = ovoid.Shape.box((1, 1, 1), allowance=[0.25, 0, [0, 3, 0]])
        self.assertEqual((slab.allowance, slab.allowance_axis), ((0.25, 0), (0, 1, 0)))
        for wrong in ((1,), (1, 0, 2), (1, 0, (1, 2)), 3, "no"):
            with self.assertRaises(TypeError):
                ovoid.Shape.sphere(1, allowance=wrong)
        cube = ovoid.Shape.from_faces(BOX.vertices, BOX.faces)
        self.assertEqual(cube.volume, 48)
        class Mesh:
            vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        self.assertAlmostEqual(ovoid.Shape.hull_of(Mesh()).volume, 1 / 6)

    def test_cut_and_moved(self):
        below, above = BOX.divided((1, 0, 0), 0.5)
        self.assertAlmostEqual(below.volume, 36)
        self.assertAlmostEqual(above.volume, 12)
        self.assertEqual(BOX.divided((1, 0, 0), 5)[1], None)
        moved = BOX.deformed([(2 * x, y, z) for x, y, z in BOX.vertices.tolist()])
        self.assertEqual(moved.volume, 96)

    def test_bytes(self):
        rock = ovoid.Shape.from_points([(math.sin(i), math.cos(3 * i), math.sin(7 * i + 1)) for i in range(50)], rounding=0.1)
        for again in (pickle.loads(pickle.dumps(rock)), ovoid.Shape.from_bytes(bytearray(rock.to_bytes()))):
            self.assertEqual(again.to_bytes(), rock.to_bytes())
        self.assertIs(copy.deepcopy(rock), rock)
        with self.assertRaises(ovoid.Error) as caught:
            ovoid.Shape.from_bytes(rock.to_bytes()[:-1])
        self.assertEqual(caught.exception.code, ovoid.Code.FORMAT)

    @unittest.skipUnless(ovoid.has_io, "built without libovoid_io")
    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "box.ovoid")
            BOX.write(path)
            self.assertEqual(ovoid.read(path).to_bytes(), BOX.to_bytes())
            mesh = os.path.join(folder, "corner.off")
            with open(mesh, "w") as file:
                file.write("OFF\n4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
            self.assertAlmostEqual(ovoid.read(mesh, scale=2).volume, 8 / 6)
            # Points alone are their hull; a shape that is meant is no less said to be one.
            self.assertEqual(ovoid.read(mesh).to_bytes(), ovoid.read(mesh, hull=True).to_bytes())
            with self.assertRaisesRegex(ovoid.Error, "nowhere") as caught:
                ovoid.read(os.path.join(folder, "nowhere.stl"))
            self.assertEqual(caught.exception.code, ovoid.Code.FILE)


class Arguments(unittest.TestCase):
    def test_unknown(self):
        """An argument that there is not is refused with the one that is meant."""
        world = ovoid.World()
        for call, said in ((lambda: ovoid.distance(BOX, BOX, pose_q=None), r"distance\(\) has no argument 'pose_q': did you mean 'pose_[ab]'"),
                           (lambda: ovoid.collide(BOX, BOX, tolerance=1), r"collide\(\) has no argument 'tolerance'$"),
                           (lambda: ovoid.Shape.box((1, 1, 1), roundng=1), r"box\(\) has no argument 'roundng': did you mean 'rounding'\?"),
                           (lambda: ovoid.Pose.from_rpy((0, 0, 0), rpi=(0, 0, 0)), "did you mean 'rpy'"),
                           (lambda: world.cast_ray((0, 0, 0), (1, 0, 0), lenght=3), "did you mean 'length'"),
                           (lambda: world.add(BOX, mask_=3), "did you mean 'mask'"),
                           (lambda: world.add(BOX, **{"x" * 100: 3}), "has no argument 'x*'$"), (lambda: world.add(BOX, **{"": 3}), "has no argument ''$")):
            with self.assertRaisesRegex(TypeError, said):
                call()


class Poses(unittest.TestCase):
    def test_three_numbers_are_a_position(self):
        there = ovoid.Pose.from_quaternion((1, 2, 3), wxyz=(1, 0, 0, 0))
        for given in (1, 2, 3), [1.0, 2.0, 3.0], there.matrix[:3, 3] if hasattr(there.matrix, "T") else (1, 2, 3):
            self.assertEqual(ovoid.Pose(given), there)
            self.assertEqual(ovoid.Pose.from_translation(given), there)
        self.assertEqual(ovoid.distance(BOX, BOX, None, (9, 0, 0)).lower,
                         ovoid.distance(BOX, BOX, None, ovoid.Pose((9, 0, 0))).lower)
        self.assertEqual(ovoid.Bodies(BOX, [(0, 0, 0), (9, 0, 0)]).__len__(), 2)
        for bad, sentence in ((1, 2), "Rotation"), ((1, 2, 3, 4), "shape"), ((1, 2, math.nan), "NaN"), ((1, 2, "x"), ""):
            with self.assertRaisesRegex((TypeError, ValueError), sentence):
                ovoid.Pose(bad)

    def test_orders_are_named(self):
        quarter = ovoid.Pose.from_quaternion((0, 0, 0), wxyz=(1, 0, 0, 1))
        self.assertEqual(quarter, ovoid.Pose.from_quaternion((0, 0, 0), xyzw=(0, 0, 1, 1)))
        self.assertEqual(quarter.wxyz, (1, 0, 0, 1))
        self.assertEqual(quarter.xyzw, (0, 0, 1, 1))
        # A quarter turn about z takes x to y.
        for given, wanted in zip(quarter.apply((1, 0, 0)).tolist(), (0, 1, 0)):
            self.assertAlmostEqual(given, wanted)
        for arguments in ({}, {"wxyz": (1, 0, 0, 0), "xyzw": (0, 0, 0, 1)}):
            with self.assertRaisesRegex(ovoid.Error, "names the order"):
                ovoid.Pose.from_quaternion((0, 0, 0), **arguments)
        with self.assertRaisesRegex(TypeError, "wxyz"):
            ovoid.Pose(((0, 0, 0), (1, 0, 0, 0)))

    def test_scipy_like_rotation(self):
        class Rotation:
            def as_quat(self):
                return [0, 0, 1, 1]
        quarter = ovoid.Pose.from_quaternion((1, 2, 3), wxyz=(1, 0, 0, 1))
        self.assertEqual(ovoid.Pose(((1, 2, 3), Rotation())), quarter)
        self.assertEqual(ovoid.Pose.from_rotation((1, 2, 3), Rotation()), quarter)
        self.assertEqual(ovoid.Pose((Rotation(), [1, 2, 3])), quarter)

    def test_pairs_and_sevens(self):
        pose = ovoid.Pose.from_rpy((1, 2, 3), (0.1, 0.2, 0.3))
        turn, there = pose.rotation, pose.xyz
        self.assertEqual([list(row) for row in turn.tolist()], [row[:3] for row in pose.matrix.tolist()[:3]])
        for given in (turn, there), (there, turn), (turn.tolist(), list(there)):
            self.assertEqual(ovoid.Pose(given), ovoid.Pose(pose.matrix))
        self.assertEqual(pose.xyz_wxyz, (*there, *pose.wxyz))
        self.assertEqual(pose.xyz_xyzw, (*there, *pose.xyzw))
        self.assertEqual(ovoid.Pose.from_xyz_wxyz(pose.xyz_wxyz), pose)
        self.assertEqual(ovoid.Pose.from_xyz_xyzw(list(pose.xyz_xyzw)), pose)
        for bad, sentence in ((pose.xyz_wxyz, "from_xyz_wxyz or"), ((there, there), "3x3"), ((turn, turn), "3x3"), ((there, [[1, 0, 0]] * 3), "no rotation"),
                              ((there, [[1, 0], [0, 1]]), "shape"), (([[1, 0, 0]], there), "shape")):
            with self.assertRaisesRegex((TypeError, ovoid.Error), sentence):
                ovoid.Pose(bad)
        for make in ovoid.Pose.from_xyz_wxyz, ovoid.Pose.from_xyz_xyzw:
            for bad, sentence in (pose.xyz, "shape"), ((0,) * 7, "quaternion is zero"), ((math.nan,) * 7, "NaN"):
                with self.assertRaisesRegex(ovoid.Error, sentence):
                    make(bad)

    def test_conversions(self):
        pose = ovoid.Pose.from_rpy((1, 2, 3), (0.1, 0.2, 0.3))
        again = ovoid.Pose(pose.matrix)
        self.assertEqual(again.xyz, (1, 2, 3))
        for a, b in zip(again.wxyz, pose.wxyz):
            self.assertAlmostEqual(a, b, delta=1e-15)
        matrix = [list(row)[:3] for row in pose.matrix.tolist()[:3]]
        self.assertEqual(ovoid.Pose.from_rotation((1, 2, 3), matrix), again)
        identity = pose @ pose.inverse()
        for number in identity.xyz:
            self.assertAlmostEqual(number, 0, delta=1e-14)
        points = [(1.0, 2.0, 3.0), (-1.0, 0.5, 0.0)]
        for there, back in zip(points, pose.apply_inverse(pose.apply(points)).tolist()):
            for a, b in zip(there, back):
                self.assertAlmostEqual(a, b, delta=1e-14)
        self.assertEqual(pickle.loads(pickle.dumps(pose)), pose)
        self.assertEqual(eval(repr(pose), {"Pose": ovoid.Pose}), pose)
        turned = ovoid.Pose.from_axis_angle((0, 0, 0), (0, 0, 2), math.pi / 2)
        self.assertAlmostEqual(turned.apply((1, 0, 0)).tolist()[1], 1)

    def test_refused(self):
        for bad, sentence in ((lambda: ovoid.Pose.from_quaternion((0, 0, 0), wxyz=(0, 0, 0, 0)), "zero"),
                              (lambda: at(math.nan), "NaN"), (lambda: at(1e60), "range"),
                              (lambda: ovoid.Pose([[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 0], [0, 0, 0, 1]]), "rotation"),
                              (lambda: ovoid.Pose.from_axis_angle((0, 0, 0), (0, 0, 0), 1), "axis")):
            with self.assertRaisesRegex(ovoid.Error, sentence):
                bad()


class Queries(unittest.TestCase):
    def test_closed_forms(self):
        for query in (ovoid.distance, ovoid.depth):
            answer = query(BOX, BALL, None, at(4))
            self.assertLessEqual(answer.lower, 2.5)
            self.assertGreaterEqual(answer.upper, 2.5)
            self.assertLess(answer.upper - answer.lower, 1e-8)
            self.assertEqual(answer.status, ovoid.Status.SEPARATED)
            self.assertEqual(answer.normal, (1, 0, 0))
            self.assertAlmostEqual(answer.point_b[0] - answer.point_a[0], 2.5)
            self.assertAlmostEqual(answer.distance, 2.5, delta=1e-8)
            ovoid.verify(answer)
        answer = ovoid.depth(BOX, BALL, None, at(0.75))
        self.assertLessEqual(answer.lower, -0.75)
        self.assertGreaterEqual(answer.upper, -0.75)
        self.assertEqual(str(answer.status), "overlapping")
        self.assertTrue(ovoid.is_proven(answer))
        self.assertTrue(math.isnan(ovoid.collide(BOX, BALL, None, at(40)).distance))

    def test_which_pose_is_whose(self):
        answer = ovoid.distance(BOX, BALL, at(10), at(4))
        self.assertAlmostEqual(answer.distance, 4.5, delta=1e-8)
        self.assertEqual((answer.a, answer.b), (BOX, BALL))
        self.assertEqual((answer.pose_a, answer.pose_b), (at(10), at(4)))
        self.assertAlmostEqual(answer.point_a[0], 9)
        self.assertEqual(answer.normal, (-1, 0, 0))

    def test_within(self):
        answer = ovoid.within(BOX, BALL, None, at(4), margin=3)
        self.assertIs(answer.is_within(3), True)
        answer = ovoid.within(BOX, BALL, None, at(4), margin=2)
        self.assertIs(answer.is_within(2), False)
        self.assertIs(answer.is_within(answer.lower + 0.5 * (answer.upper - answer.lower)), None)

    def test_options(self):
        answer = ovoid.distance(BOX, BALL, None, at(40), cap=1)
        self.assertEqual(answer.limit, ovoid.Limit.CAP)
        wide = ovoid.distance(BOX, ovoid.Shape.capsule(1, 1), None, ovoid.Pose.from_rpy((4, 3, 1), (1, 2, 3)),
                              absolute_tolerance=0.5)
        self.assertLessEqual(wide.upper - wide.lower, 0.5)
        rocks = [ovoid.Shape.from_points([(math.sin(i * k), math.cos(3 * i), math.sin(7 * i + k)) for i in range(90)])
                 for k in (1, 2)]
        self.assertEqual(ovoid.distance(*rocks, None, at(2, 1, 1), iterations=1).limit, ovoid.Limit.ITERATIONS)

    def test_warm_start(self):
        cold = ovoid.distance(BOX, BOX, None, at(4, 1, 1))
        for earlier in (cold, cold.proof):
            warm = ovoid.distance(BOX, BOX, None, at(4, 1, 1), earlier=earlier)
            self.assertEqual(warm.stage, ovoid.Stage.PROOF)
            ovoid.verify(warm)
        # A proof of another pair is no trouble.
        ovoid.verify(ovoid.distance(BALL, BALL, None, at(4), earlier=cold))

    def test_warm_depth(self):
        # A depth starts from the cover of an earlier answer, which another query does not take over.
        points = [(math.cos(i) * math.sin(2.4 * i), math.sin(i) * math.sin(2.4 * i), math.cos(2.4 * i)) for i in range(40)]
        hull, answer, stages = ovoid.Shape.from_points(points), None, []
        for i in range(20):
            pose = ovoid.Pose.from_quaternion((0.5 + 0.002 * i, 0.1, 0.2), wxyz=(1, 0.003 * i, 0.1, 0))
            answer = ovoid.depth(hull, hull, None, pose, earlier=answer)
            cold = ovoid.depth(hull, hull, None, pose)
            ovoid.verify(answer)
            self.assertTrue(answer.lower <= cold.upper and cold.lower <= answer.upper)
            stages.append(answer.stage)
        self.assertGreater(stages.count(ovoid.Stage.PROOF), 10)
        ovoid.verify(ovoid.depth(BALL, BALL, None, at(0.1), earlier=answer))
        ovoid.verify(ovoid.distance(hull, hull, None, pose, earlier=answer))

    def test_compounds(self):
        dumbbell = ovoid.Compound([BALL, BALL], [at(-2), at(2)])
        answer = ovoid.distance(dumbbell, BALL, None, at(4))
        self.assertEqual((answer.part_a, answer.part_b), (1, 0))
        self.assertAlmostEqual(answer.distance, 1, delta=1e-8)
        ovoid.verify(answer)
        again = ovoid.distance(pickle.loads(pickle.dumps(dumbbell)), BALL, None, at(4), earlier=answer)
        self.assertAlmostEqual(again.lower, answer.lower, delta=1e-8)
        self.assertEqual(again.part_a, 1)
        deep = ovoid.depth(dumbbell, dumbbell, None, at(0, 0.25))
        self.assertAlmostEqual(deep.distance, -0.75, delta=1e-8)
        ovoid.verify(deep)
        self.assertEqual(len(dumbbell), 2)
        self.assertEqual(dumbbell.poses[1], at(2))
        with self.assertRaises(ovoid.Error) as caught:
            ovoid.Compound([])
        self.assertEqual(caught.exception.code, ovoid.Code.EMPTY)

    def test_compounds_of_many_parts_are_checked(self):
        # More exclusions than the first guess has room for.
        plate = ovoid.Compound([BALL] * 400, [at(1.5 * (i % 20), 1.5 * (i // 20)) for i in range(400)])
        for z in (1.5, 2, 3):
            answer = ovoid.distance(plate, plate, None, ovoid.Pose.from_axis_angle((0.3, 0.2, z), (1, 2, 0), 0.01))
            ovoid.verify(answer)

    def test_refused(self):
        for bad, kind, sentence in (
                (lambda: ovoid.distance(BOX, None), TypeError, "b: a Shape, Compound or Solid"),
                (lambda: ovoid.distance(BOX), TypeError, "two bodies"),
                (lambda: ovoid.within(BOX, BALL), TypeError, "margin="),
                (lambda: ovoid.distance(BOX, BALL, margin=1), TypeError, "no argument 'margin'"),
                (lambda: ovoid.distance(BOX, BALL, tolerance=1), TypeError, "no argument 'tolerance'"),
                (lambda: ovoid.distance(BOX, BALL, None, pose_b=None, a=BOX), TypeError, "'a' twice"),
                (lambda: ovoid.distance(BOX, BALL, None, None, 3), TypeError, "by name"),
                (lambda: ovoid.distance(BOX, BALL, cap="x"), TypeError, "cap: a number"),
                (lambda: ovoid.distance(BOX, BALL, cap=math.nan), ovoid.Error, "NaN"),
                (lambda: ovoid.distance(BOX, BALL, iterations=-1), ovoid.Error, "iterations"),
                (lambda: ovoid.distance(BOX, BALL, earlier=3), TypeError, "earlier: an Answer, or an array of one proof"),
                (lambda: ovoid.within(BOX, BALL, margin=-1), ovoid.Error, "negative"),
                (lambda: ovoid.verify(3), TypeError, "Answer"),
                (lambda: ovoid.Shape(((0, 0, 0),)), TypeError, "is made by Shape.from_points"),
                (lambda: ovoid.Solid(), TypeError, "is made by Solid.from_triangles"),
                (lambda: ovoid.Shape.from_points([]), ovoid.Error, "point"),
                (lambda: ovoid.Shape.from_points([(0, 0)]), ovoid.Error, r"\(n, 3\)"),
                (lambda: ovoid.Shape.from_points([(0, 0, 0), (0, 0)]), ovoid.Error, "3 items"),
                (lambda: ovoid.Shape.from_points([(0, 0, None)]), TypeError, "NoneType"),
                (lambda: ovoid.Shape.from_points("points"), TypeError, "points"),
                (lambda: ovoid.Shape.box((1, 1, 1), inner="best"), ovoid.Error, "'maximum', 'phases' or 'lean'"),
                (lambda: ovoid.Shape.prism(1, 1, 2), ovoid.Error, "sides"),
                (lambda: ovoid.Shape.from_faces([(0, 0, 0)], [(0, 1, -2)]), ovoid.Error, "no vertex -2")):
            with self.assertRaisesRegex(kind, sentence):
                bad()

    def test_place(self):
        with self.assertRaises(ovoid.Error) as caught:
            ovoid.Shape.from_points([(0, 0, 0), (0, math.inf, 0)])
        self.assertEqual((caught.exception.code, caught.exception.place), (ovoid.Code.NOT_FINITE, 1))
        again = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((again.args, again.code, again.place), (caught.exception.args, ovoid.Code.NOT_FINITE, 1))


class Arrays(unittest.TestCase):
    @needs_numpy
    def test_kinds_and_strides(self):
        points = numpy.array(BOX.vertices)
        wanted = BOX.to_bytes()
        wide = numpy.zeros((8, 7))
        wide[:, 1::2] = points
        for given in (points.astype(numpy.float32), points.astype(numpy.int8), points.astype(numpy.uint64).astype(int)
                      if (points >= 0).all() else points.astype(numpy.int64), numpy.asfortranarray(points), wide[:, 1::2],
                      numpy.flip(numpy.flip(points)), points.tolist(), memoryview(points)):
            self.assertEqual(ovoid.Shape.from_points(given).to_bytes(), wanted)

    @needs_numpy
    def test_refused_kinds(self):
        points = numpy.array(BOX.vertices)
        for bad in (points.astype(complex), points.astype(object), points.astype(">f8"), points.astype(numpy.float16),
                    points.astype(numpy.longdouble), points.astype(str), points.astype("datetime64[s]")):
            with self.assertRaises(TypeError, msg=bad.dtype):
                ovoid.Shape.from_points(bad)

    @unittest.skipIf(numpy, "with NumPy there are its arrays")
    def test_repr_has_the_shape(self):
        self.assertEqual(repr(BOX.vertices), "<ovoid.Array of numbers, shape (8, 3): tolist()>")

    def test_answers_are_neither_true_nor_false(self):
        """A status equals its word and raises for another; bool() of an answer raises with what to ask."""
        box, far = ovoid.Shape.box([1, 1, 1]), [3, 0, 0]
        answer = ovoid.collide(box, box, None, far)
        self.assertTrue(answer.status == "separated" and answer.status != "overlapping" and "separated" == answer.status)
        self.assertFalse(answer.status != "separated")
        self.assertEqual((answer.status, {answer.status: 1}[1], answer.status in ("touching", "separated")), (1, 1, True))
        self.assertNotEqual(answer.status, None)
        for wrong in ("apart", "Separated", "hit"):
            with self.assertRaisesRegex(ValueError, "undecided, separated, touching, overlapping"):
                answer.status == wrong  # noqa: B015
            with self.assertRaises(ValueError):
                answer.status != wrong  # noqa: B015
        start, end = ovoid.Motion.poses(far, [9, 0, 0]), ovoid.Motion.poses(None, None)
        solid = ovoid.Solid.from_triangles([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
        for given in (answer, ovoid.distance(box, solid, None, far), ovoid.find_impact(box, box, end, start), ovoid.find_approach(box, box, end, start),
                      ovoid.cast_ray(box, None, [5, 0, 0], [-1, 0, 0])):
            with self.assertRaisesRegex(TypeError, "compare its status"):
                bool(given)

    def test_names_are_the_librarys(self):
        for name, words in ovoid._ovoid._get_names().items():
            members = list(getattr(ovoid, name))
            self.assertEqual([int(member) for member in members], list(range(len(members))))
            self.assertEqual([word for word in words if not word.startswith("unknown")][len(members):], [])
            if name != "Code":
                self.assertEqual([str(member) for member in members], words[:len(members)])


class LargeDepths(unittest.TestCase):
    """Round bodies with one centre, whose depth needs more points than a search holds by itself."""

    @classmethod
    def setUpClass(cls):
        points = []
        for i in range(800):
            z = 2 * (i + 0.5) / 800 - 1
            r = math.sqrt(1 - z * z)
            points.append([r * math.cos(2.399963229728653 * i), r * math.sin(2.399963229728653 * i), z])
        cls.ball = ovoid.Shape.from_points(points)
        cls.turned = ovoid.Pose.from_quaternion((0, 0, 0), wxyz=(0.3, 0.4, 0.5, 0.7))

    def check(self, answer):
        self.assertEqual(answer.limit, ovoid.Limit.NONE)
        self.assertLess(answer.upper - answer.lower, 1e-8)
        ovoid.verify(answer)
        ovoid.verify(pickle.loads(pickle.dumps(answer)))

    def test_shapes(self):
        answer = ovoid.depth(self.ball, self.ball, None, self.turned)
        self.check(answer)
        self.check(ovoid.depth(self.ball, self.ball, None, self.turned, earlier=answer))
        ovoid.gradient(answer)

    def test_compounds(self):
        parts = ovoid.Compound([self.ball, self.ball], [at(0), at(5)])
        self.check(ovoid.depth(parts, self.ball, None, self.turned))

    def test_manifold(self):
        found = ovoid.find_manifold(self.ball, self.ball, None, self.turned)
        self.assertLess(found.upper - found.lower, 1e-8)
        ovoid.verify(found)


if __name__ == "__main__":
    common.main()
