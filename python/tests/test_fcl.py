"""ovoid.fcl: python-fcl's names; distances, contacts and times against closed forms; the lists of triangles against all
pairs of them; managers against all pairs of objects. trimesh.collision runs on it where trimesh is installed."""

import itertools
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

from common import main, needs_numpy, numpy as np

import ovoid

NAMES = """BVHModel Box CCDMotionType CCDSolverType Capsule CollisionData CollisionGeometry CollisionObject CollisionRequest CollisionResult
Cone Contact ContinuousCollisionRequest ContinuousCollisionResult Convex CostSource Cylinder DistanceData DistanceRequest DistanceResult
DynamicAABBTreeCollisionManager Ellipsoid GJKSolverType Halfspace NODE_TYPE OBJECT_TYPE OcTree Plane Sphere Transform TriangleP collide
continuousCollide defaultCollisionCallback defaultDistanceCallback distance""".split()

USER = """
import numpy as np

from ovoid import fcl

ball = fcl.Sphere(0.5)
a, b = fcl.CollisionObject(fcl.Box(1, 1, 1), fcl.Transform()), fcl.CollisionObject(ball, fcl.Transform(np.array([2.0, 0, 0])))
result = fcl.CollisionResult()
count: int = fcl.collide(a, b, fcl.CollisionRequest(num_max_contacts=4, enable_contact=True), result)
depths: list[float] = [contact.penetration_depth for contact in result.contacts]
far: float = fcl.distance(a, b, fcl.DistanceRequest(), fcl.DistanceResult())
manager = fcl.DynamicAABBTreeCollisionManager()
manager.registerObjects([a, b])
manager.collide(fcl.CollisionData(), fcl.defaultCollisionCallback)
radius: float = ball.radius
"""


def make_mesh(fcl, points, faces):
    mesh = fcl.BVHModel()
    mesh.beginModel(len(faces), len(points))
    mesh.addSubModel(points, faces)
    mesh.endModel()
    return mesh


def make_ball(fcl, radius, rings=6):
    points = [(0, 0, radius)]
    for i, k in itertools.product(range(1, rings), range(2 * rings)):
        a, b = np.pi * i / rings, np.pi * k / rings
        points.append((radius * np.sin(a) * np.cos(b), radius * np.sin(a) * np.sin(b), radius * np.cos(a)))
    points.append((0, 0, -radius))
    solid = ovoid.Shape.from_points(points)
    return make_mesh(fcl, np.array(solid.vertices), [f[:3] for f in _triangulate(solid.faces)])


def _triangulate(faces):
    for face in faces:
        yield from ((face[0], face[k], face[k + 1]) for k in range(1, len(face) - 1))


@needs_numpy
class Fcl(unittest.TestCase):
    def setUp(self):
        import ovoid.fcl

        self.fcl = ovoid.fcl

    def at(self, geometry, *xyz):
        return self.fcl.CollisionObject(geometry, self.fcl.Transform(np.array(xyz, dtype=float)))

    def test_names(self):
        self.assertEqual(sorted(NAMES), sorted(self.fcl.__all__))
        for name in NAMES:
            self.assertTrue(hasattr(self.fcl, name), name)

    def test_distances(self):
        fcl = self.fcl
        cases = [
            (fcl.Box(1, 2, 3), 0.5, 1e-9),
            (fcl.Sphere(0.75), 0.75, 1e-9),
            (fcl.Capsule(0.25, 1), 0.25, 1e-9),
            (fcl.Cylinder(0.5, 1), 0.5, 1e-4),
            (fcl.Cone(0.5, 1), 0.5, 1e-4),
            (fcl.Ellipsoid(0.6, 0.4, 0.3), 0.6, 1e-3),
            (fcl.Convex([(0.5, 0, 0), (-1, 1, 0), (-1, -1, 0), (-1, 0, 1)], 0, []), 0.5, 1e-9),
            (fcl.TriangleP([0.5, 0, 0], [-1, 1, 0], [-1, -1, 1]), 0.5, 1e-9),
        ]
        for geometry, reach, tolerance in cases:
            name = type(geometry).__name__
            result = fcl.DistanceResult()
            found = fcl.distance(self.at(geometry, 0, 0, -0.5 if name == "Cone" else 0), self.at(fcl.Sphere(1), 5, 0, -1), result=result)
            wall = fcl.distance(self.at(geometry, 0, 0, 0), self.at(fcl.Halfspace(np.array([-2.0, 0, 0]), -8.0), 0, 0, 0))
            self.assertAlmostEqual(wall, 4 - reach, delta=1e-9, msg=name)
            self.assertAlmostEqual(found, np.linalg.norm(np.subtract(*result.nearest_points)), delta=2 * tolerance, msg=name)
            sheet = fcl.distance(self.at(geometry, 0, 0, 0), self.at(fcl.Plane(np.array([1.0, 0, 0]), 4.0), 0, 0, 0))
            self.assertAlmostEqual(sheet, 4 - reach, delta=1e-9, msg=name)
            slab = fcl.distance(self.at(geometry, 0, 0, 0), self.at(fcl.Box(2, 40, 40), 5, 0, 0))
            self.assertAlmostEqual(slab, 4 - reach, delta=tolerance, msg=name)

    def test_signs(self):
        fcl = self.fcl
        box, ball = self.at(fcl.Box(2, 2, 2), 0, 0, 0), self.at(fcl.Sphere(0.5), 1.25, 0, 0)
        self.assertEqual(fcl.distance(box, ball), -1)
        signed = fcl.DistanceRequest(enable_signed_distance=True)
        self.assertAlmostEqual(fcl.distance(box, ball, signed), -0.25, delta=1e-8)
        result = fcl.CollisionResult()
        self.assertEqual(fcl.collide(box, ball, fcl.CollisionRequest(10, True), result), 1)
        contact = result.contacts[0]
        self.assertTrue(contact.o1 is box._geometry and contact.o2 is ball._geometry)
        np.testing.assert_allclose(contact.normal, (1, 0, 0), atol=1e-9)
        self.assertAlmostEqual(contact.penetration_depth, 0.25, delta=1e-8)
        back = fcl.CollisionResult()
        fcl.collide(ball, box, fcl.CollisionRequest(1, True), back)
        np.testing.assert_allclose(back.contacts[0].normal, (-1, 0, 0), atol=1e-9)
        floor = self.at(fcl.Plane(np.array([0.0, 0, 1]), -0.75), 0, 0, 0)
        self.assertAlmostEqual(fcl.distance(box, floor, signed), -0.25, delta=1e-12)
        self.assertEqual(fcl.distance(box, floor), -1)

    def test_changes(self):
        fcl = self.fcl
        ball = fcl.Sphere(1)
        a, b = self.at(ball, 0, 0, 0), self.at(fcl.Box(2, 2, 2), 4, 0, 0)
        self.assertAlmostEqual(fcl.distance(a, b), 2, delta=1e-9)
        ball.radius = 1.5
        self.assertAlmostEqual(fcl.distance(a, b), 1.5, delta=1e-9)
        b.setTranslation(np.array([5.0, 0, 0]))
        self.assertAlmostEqual(fcl.distance(a, b), 2.5, delta=1e-9)

    def test_meshes(self):
        fcl = self.fcl
        request = fcl.CollisionRequest(100000, True)
        meshes = make_ball(fcl, 0.5), make_ball(fcl, 0.4, 5)
        for x in (0.1, 0.6, 0.85, 1.2):
            a, b = self.at(meshes[0], 0, 0, 0), self.at(meshes[1], x, 0.05, 0.03)
            for other in (b, self.at(fcl.Sphere(0.4), x, 0.05, 0.03)):
                result = fcl.CollisionResult()
                fcl.collide(a, other, request, result)
                found = {(c.b1, c.b2) for c in result.contacts}
                self.assertEqual(len(found), len(result.contacts))
                self.assertEqual(found, self.find_all(a, other), (x, other.getNodeType()))
        inner = self.at(make_ball(fcl, 0.1), 0, 0, 0)
        self.assertEqual(fcl.collide(self.at(meshes[0], 0, 0, 0), inner), 0)
        self.assertGreater(fcl.distance(self.at(meshes[0], 0, 0, 0), inner), 0.3)
        crossing = self.at(meshes[0], 0, 0, 0), self.at(meshes[1], 0.85, 0, 0)
        self.assertEqual(fcl.distance(*crossing), 0)
        self.assertLess(fcl.distance(*crossing, fcl.DistanceRequest(enable_signed_distance=True)), 0)

    def find_all(self, a, b):
        """All pairs of parts that are not proven apart."""
        def parts(o):
            body = o._geometry._get_body()
            if isinstance(body, ovoid.Shape):
                return [(-1, body)]
            return [(i, ovoid.Shape.from_points(np.array(body.vertices)[list(f)])) for i, f in enumerate(body.faces)]

        poses = a._transform._pose(), b._transform._pose()
        return {
            (i, j)
            for (i, x), (j, y) in itertools.product(parts(a), parts(b))
            if ovoid.collide(x, y, *poses).status != ovoid.Status.SEPARATED
        }

    def test_motions(self):
        fcl = self.fcl
        a, b = self.at(fcl.Box(1, 1, 1), 0, 0, 0), self.at(fcl.Box(1, 1, 1), -5, 0, 0)
        result = fcl.ContinuousCollisionResult()
        kinds = fcl.CCDMotionType
        for kind in (kinds.CCDM_TRANS, kinds.CCDM_LINEAR, kinds.CCDM_SCREW):
            request = fcl.ContinuousCollisionRequest(ccd_motion_type=kind)
            end = fcl.Transform(np.array([5.0, 0, 0]))
            self.assertAlmostEqual(fcl.continuousCollide(a, fcl.Transform(), b, end, request, result), 0.4, delta=1e-6)
            self.assertTrue(result.is_collide)
        self.assertEqual(fcl.continuousCollide(a, fcl.Transform(), b, fcl.Transform(np.array([-2.0, 0, 0]))), 1)
        # Half a turn about the z axis through (0, 2, 0): the ball goes round by x = 2.
        turned = fcl.Transform(np.diag([-1.0, -1, 1]), np.array([0.0, 4, 0]))
        request = fcl.ContinuousCollisionRequest(ccd_motion_type=kinds.CCDM_SCREW)
        hit = [fcl.continuousCollide(self.at(fcl.Sphere(0.1), x, 2, 0), fcl.Transform(np.array([x, 2.0, 0])), self.at(fcl.Box(0.1, 0.1, 0.1), 0, 0, 0), turned, request) for x in (2, -2)]
        self.assertEqual(sorted(t < 1 for t in hit), [False, True])
        with self.assertRaises(ValueError):
            fcl.continuousCollide(a, fcl.Transform(), b, end, fcl.ContinuousCollisionRequest(ccd_motion_type=kinds.CCDM_SPLINE))

    def test_managers(self):
        fcl = self.fcl
        numbers = np.random.RandomState(3)
        objects = [self.at(fcl.Box(*numbers.uniform(0.2, 1, 3)), *numbers.uniform(-2, 2, 3)) for _ in range(30)]
        others = [self.at(fcl.Capsule(0.2, 0.5), *numbers.uniform(-2, 2, 3)) for _ in range(10)]
        first, second = fcl.DynamicAABBTreeCollisionManager(), fcl.DynamicAABBTreeCollisionManager()
        first.registerObjects(objects)
        second.registerObjects(others)
        first.setup()
        second.setup()
        self.assertEqual((first.size(), first.empty()), (30, False))

        def check(pairs, *who):
            pairs = list(pairs)
            data = fcl.CollisionData(fcl.CollisionRequest(1000000))
            first.collide(*who, data, fcl.defaultCollisionCallback)
            self.assertEqual(len(data.result.contacts), sum(fcl.collide(a, b) for a, b in pairs))
            near = fcl.DistanceData(fcl.DistanceRequest(enable_signed_distance=False))
            first.distance(*who, near, fcl.defaultDistanceCallback)
            least = min(fcl.distance(a, b) for a, b in pairs)
            self.assertTrue(near.result.min_distance == least or max(near.result.min_distance, least) <= 0)

        check(itertools.combinations(objects, 2))
        check(((others[0], o) for o in objects), others[0])
        check(itertools.product(objects, others), second)
        far = [self.at(fcl.Sphere(0.1), 9 + 3 * i, 0, 0) for i in range(3)]
        lonely = fcl.DynamicAABBTreeCollisionManager()
        lonely.registerObjects(far)
        lonely.setup()
        near = fcl.DistanceData()
        lonely.distance(near, fcl.defaultDistanceCallback)
        self.assertAlmostEqual(near.result.min_distance, 2.8, delta=1e-9)
        far[0].setTranslation(np.array([14.9, 0, 0]))
        lonely.update(far[0])
        data = fcl.CollisionData()
        lonely.collide(data, fcl.defaultCollisionCallback)
        self.assertTrue(data.result.is_collision)
        lonely.unregisterObject(far[0])
        data = fcl.CollisionData()
        lonely.collide(data, fcl.defaultCollisionCallback)
        self.assertFalse(data.result.is_collision)

    def test_order(self):
        """Pairs come by the distance of their boxes, each once, whatever is compared at once. Truth: all pairs, sorted."""
        fcl = self.fcl
        numbers = np.random.RandomState(4)

        def place(count):
            return [self.at(fcl.Box(*numbers.uniform(0.1, 1, 3)), *numbers.uniform(-3, 3, 3)) for _ in range(count)]

        def measure(a, b):
            (low, high), (low_b, high_b) = a._aabb(), b._aabb()
            return float(np.linalg.norm(np.maximum(0, np.maximum(low - high_b, low_b - high))))

        def record(manager, *who):
            seen, touching = [], []
            manager.distance(*who, seen, lambda a, b, data: (data.append((measure(a, b), id(a), id(b))), (False, np.inf))[1])
            manager.collide(*who, touching, lambda a, b, data: data.append((measure(a, b), id(a), id(b))))
            self.assertEqual(touching, [pair for pair in seen if pair[0] == 0])
            return seen

        objects, others = [*place(40), self.at(fcl.Halfspace([0, 0, 1], -9), 0, 0, 0)], place(25)
        first, second = fcl.DynamicAABBTreeCollisionManager(), fcl.DynamicAABBTreeCollisionManager()
        first.registerObjects(objects)
        second.registerObjects(others)
        own = sorted(((measure(a, b), i, j) for (i, a), (j, b) in itertools.combinations(enumerate(objects), 2)))
        both = sorted(((measure(a, b), i, j) for i, a in enumerate(objects) for j, b in enumerate(others)))
        block = fcl._BLOCK
        for fcl._BLOCK in (7, block):
            self.assertEqual(record(first), [(gap, id(objects[i]), id(objects[j])) for gap, i, j in own])
            self.assertEqual(record(first, second), [(gap, id(objects[i]), id(others[j])) for gap, i, j in both])
        fcl._BLOCK = block

    @unittest.skipUnless(shutil.which("mypy"), "needs mypy")
    def test_mypy(self):
        """A user's program by mypy --strict: no error in it, none in this module, and a mistake is one."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "user.py")
            environment = dict(os.environ, MYPYPATH=os.path.dirname(os.path.dirname(self.fcl.__file__)))
            environment.pop("LD_PRELOAD", None)  # a sanitizer's runtime, which is not for mypy
            for text, count in ((USER, 0), (USER + "fcl.Sphere(a)\nfar = a.getRotation()\n", 2)):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
                run = subprocess.run(["mypy", "--strict", "--cache-dir", folder, path], capture_output=True, text=True, check=False, env=environment)
                faults = [line for line in run.stdout.splitlines() if " error: " in line and re.search(r"(user|/fcl|_fcl_\w+)\.py:", line)]
                self.assertEqual(len(faults), count, run.stdout + run.stderr)

    def test_boxes(self):
        """Every change of an object moves its box at the next update, and nothing else computes a box anew."""
        fcl = self.fcl
        bar, wall = fcl.Box(4, 1, 1), self.at(fcl.Box(1, 1, 1), 0, 2, 0)
        moving = self.at(bar, 0, 0, 0)
        manager = fcl.DynamicAABBTreeCollisionManager()
        manager.registerObjects([moving, wall, *(self.at(fcl.Sphere(0.1), 9 + i, 0, 0) for i in range(50))])
        upright = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])

        def resize():
            bar.side = np.array([1.0, 4, 1])

        changes = [
            (lambda: moving.setRotation(upright), True),
            (lambda: moving.setTranslation(np.array([0.0, -3, 0])), False),
            (lambda: moving.setTransform(fcl.Transform(np.array([0.0, 1, 0]))), True),
            (lambda: moving.setTransform(fcl.Transform()), False),
            (lambda: moving.setQuatRotation(np.array([0.5**0.5, 0, 0, 0.5**0.5])), True),
            (lambda: moving.setQuatRotation(np.array([1.0, 0, 0, 0])), False),
            (resize, True),
        ]
        computed = []
        compute = fcl.CollisionObject._compute_box
        with unittest.mock.patch.object(fcl.CollisionObject, "_compute_box", lambda o: computed.append(o) or compute(o)):
            for change, is_hit in changes:
                change()
                manager.update()
                data = fcl.CollisionData()
                manager.collide(data, fcl.defaultCollisionCallback)
                self.assertEqual(data.result.is_collision, is_hit)
        self.assertEqual(computed, [moving] * len(changes))

    def test_refusals(self):
        fcl = self.fcl
        a = self.at(fcl.Sphere(1), 0, 0, 0)
        with self.assertRaisesRegex(ValueError, "cost"):
            fcl.collide(a, a, fcl.CollisionRequest(enable_cost=True))
        with self.assertRaisesRegex(NotImplementedError, "octrees"):
            fcl.OcTree(0.1, b"")
        with self.assertRaisesRegex(ValueError, "without an end"):
            fcl.collide(self.at(fcl.Plane(np.array([0.0, 0, 1]), 0), 0, 0, 0), self.at(fcl.Halfspace(np.array([0.0, 0, 1]), 0), 0, 0, 0))
        with self.assertRaises(ValueError):
            fcl.Transform(np.zeros(2))
        with self.assertRaises(ValueError):
            fcl.BVHModel().endModel()
        with self.assertRaises(ValueError):
            fcl.DynamicAABBTreeCollisionManager().collide(1)
        with self.assertRaises(ovoid.Error):
            fcl.collide(a, fcl.CollisionObject(fcl.Sphere(-1)))

    def test_trimesh(self):
        sys.modules["fcl"] = self.fcl
        try:
            from trimesh import creation
            from trimesh.collision import CollisionManager
        except ImportError:
            self.skipTest("trimesh is not installed")
        manager = CollisionManager()
        move = np.eye(4)
        manager.add_object("a", creation.box((1, 1, 1)))
        move[0, 3] = 3
        manager.add_object("b", creation.icosphere(), move)
        self.assertFalse(manager.in_collision_internal())
        self.assertAlmostEqual(manager.min_distance_internal(), 1.5, delta=0.05)
        move[0, 3] = 1.2
        manager.set_transform("b", move)
        is_hit, names, contacts = manager.in_collision_internal(return_names=True, return_data=True)
        self.assertTrue(is_hit)
        self.assertEqual(names, {("a", "b")})
        self.assertGreater(contacts[0].depth, 0.2)


if __name__ == "__main__":
    main()
