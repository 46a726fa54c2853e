"""The manager with trimesh's methods. Truth: trimesh's own documented tests of its manager, with cubes whose answers are
known: a cube of size 2 in the middle and others of size 1 beside it, as in its tests/test_collision.py."""

import math
import unittest
import warnings

import common
import ovoid
from ovoid.trimesh_compat import CollisionManager


class Cube:
    """What trimesh.creation.box is to a manager."""

    is_convex = True

    def __init__(self, size):
        self.vertices = [[x * size / 2, y * size / 2, z * size / 2] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]


class Frame:
    """A square frame of height 1, from 1 to 2 around the z axis."""

    is_convex = False
    vertices = [(r * x, r * y, z) for z in (-0.5, 0.5) for r in (1, 2) for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    faces = [face for i in range(4) for k in [(i + 1) % 4]
             for a, b, c, d in ((i, i + 8, k + 8, k), (i + 4, k + 4, k + 12, i + 12), (i, k, k + 4, i + 4), (i + 8, i + 12, k + 12, k + 8))
             for face in ((a, b, c), (a, c, d))]


def shift(x, y=0, z=0):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


class Collisions(unittest.TestCase):
    def setUp(self):
        self.cube = Cube(1)
        self.manager = CollisionManager()
        self.manager.add_object("cube0", self.cube)

    def test_single(self):
        manager = self.manager
        self.assertIs(manager.in_collision_single(self.cube, shift(5)), False)
        self.assertIs(manager.in_collision_single(self.cube, shift(0.5)), True)
        hit, names, data = manager.in_collision_single(self.cube, shift(0.75), return_names=True, return_data=True)
        self.assertEqual((hit, names, len(data)), (True, {"cube0"}, 1))
        self.assertEqual(data[0].names, {"cube0", "__external"})
        self.assertAlmostEqual(data[0].depth, 0.25, delta=1e-8)
        self.assertAlmostEqual(abs(data[0].normal[0]), 1)
        self.assertTrue(0.25 - 1e-6 <= data[0].point[0] <= 0.5 + 1e-6)
        ovoid.verify(data[0].answer)
        with self.assertRaises(NotImplementedError):
            data[0].index("cube0")

    def test_internal(self):
        manager = self.manager
        manager.add_object("cube1", self.cube, shift(5))
        self.assertIs(manager.in_collision_internal(), False)
        manager.add_object("cube2", self.cube, shift(0.5))
        hit, names = manager.in_collision_internal(return_names=True)
        self.assertEqual((hit, names), (True, {("cube0", "cube2")}))
        manager.set_transform("cube1", shift(0.75))
        _, names = manager.in_collision_internal(return_names=True)
        self.assertEqual(names, {("cube0", "cube1"), ("cube0", "cube2"), ("cube1", "cube2")})
        manager.remove_object("cube0")
        hit, data = manager.in_collision_internal(return_data=True)
        self.assertEqual([contact.names for contact in data], [{"cube1", "cube2"}])
        for name in ("cube0", "nobody"):
            with self.assertRaises(ValueError):
                manager.remove_object(name)
            with self.assertRaises(ValueError):
                manager.set_transform(name, shift(0))

    def test_replaced(self):
        self.manager.add_object("cube0", Cube(4))
        self.assertTrue(self.manager.in_collision_single(self.cube, shift(2)))
        self.assertFalse(self.manager.in_collision_internal())

    def test_other(self):
        other = CollisionManager()
        other.add_object("cube1", self.cube, shift(0.5))
        other.add_object("cube2", self.cube, shift(9))
        hit, names, data = self.manager.in_collision_other(other, return_names=True, return_data=True)
        self.assertEqual((hit, names), (True, {("cube0", "cube1")}))
        self.assertEqual(data[0].names, {"cube0", "cube1"})
        other.set_transform("cube1", shift(3))
        self.assertIs(self.manager.in_collision_other(other), False)

    def test_distances(self):
        manager = self.manager
        self.assertAlmostEqual(manager.min_distance_single(self.cube, shift(3)), 2, delta=1e-8)
        manager.add_object("cube1", self.cube, shift(10))
        distance, name, data = manager.min_distance_single(self.cube, shift(4), return_name=True, return_data=True)
        self.assertEqual(name, "cube0")
        self.assertAlmostEqual(distance, 3, delta=1e-8)
        self.assertAlmostEqual(data.point("cube0")[0], 0.5)
        self.assertAlmostEqual(data.point("__external")[0], 3.5)
        distance, names = manager.min_distance_internal(return_names=True)
        self.assertEqual(names, ("cube0", "cube1"))
        self.assertAlmostEqual(distance, 9, delta=1e-8)
        self.assertAlmostEqual(manager.min_distance_internal("cube1"), 9, delta=1e-8)
        other = CollisionManager()
        other.add_object("cube2", self.cube, shift(7))
        distance, names, data = manager.min_distance_other(other, return_names=True, return_data=True)
        self.assertEqual(names, ("cube1", "cube2"))
        self.assertAlmostEqual(distance, 2, delta=1e-8)
        self.assertAlmostEqual(data.point("cube1")[0], 9.5)
        self.assertEqual(CollisionManager().min_distance_single(self.cube), math.inf)

    def test_distance_of_overlaps(self):
        self.manager.add_object("cube1", self.cube, shift(1.25))
        distance, name = self.manager.min_distance_single(self.cube, shift(0.75), return_name=True)
        self.assertEqual(name, "cube1")
        self.assertAlmostEqual(distance, -0.5, delta=1e-8)
        self.manager.set_transform("cube1", shift(0.75))
        self.assertAlmostEqual(self.manager.min_distance_internal(), -0.25, delta=1e-8)

    def test_not_convex(self):
        """A frame around a hole of 2 by 2, which a cube is in without touching it."""
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.manager.add_object("frame", Frame())
        self.assertIs(self.manager.in_collision_internal(), False)
        distance, names, data = self.manager.min_distance_internal(return_names=True, return_data=True)
        self.assertEqual(names, ("cube0", "frame"))
        self.assertAlmostEqual(distance, 0.5, delta=1e-8)
        ovoid.verify(data.answer)
        # The face that is near has the hole's edge at y = -1.
        self.manager.set_transform("cube0", shift(0, -0.2))
        _, data = self.manager.min_distance_internal(return_data=True)
        corners = [Frame.vertices[i] for i in Frame.faces[data.index("frame")]]
        self.assertTrue(sum(y == -1 for _, y, _ in corners) >= 2, corners)
        with self.assertRaises(NotImplementedError):
            data.index("cube0")
        self.manager.set_transform("cube0", shift(0.75))
        hit, names, data = self.manager.in_collision_internal(return_names=True, return_data=True)
        self.assertEqual((hit, names), (True, {("cube0", "frame")}))
        self.assertGreaterEqual(data[0].depth, 0.25)
        ovoid.verify(data[0].answer)
        self.assertLessEqual(self.manager.min_distance_internal(), -0.25)
        hit, names = self.manager.in_collision_single(Frame(), shift(0, 0, 5), return_names=True)
        self.assertEqual((hit, names), (False, set()))
        self.assertAlmostEqual(self.manager.min_distance_single(Frame(), shift(0, 0, 3)), 2, delta=1e-8)
        other = CollisionManager()
        other.add_object("ring", ovoid.Solid.from_mesh(Frame()), shift(1.5))
        hit, names = self.manager.in_collision_other(other, return_names=True)
        self.assertEqual((hit, names), (True, {("frame", "ring"), ("cube0", "ring")}))

    def test_said_to_be_convex(self):
        """What is_convex says, or that it is not there, makes no hull of a frame, nor of a box without a lid."""
        class Said(Frame):
            is_convex = True

        class Silent:
            vertices, faces = Frame.vertices, Frame.faces

        box = [(0, 2, 6, 4), (1, 5, 7, 3), (0, 4, 5, 1), (2, 3, 7, 6), (0, 1, 3, 2), (4, 6, 7, 5)]

        class Box(Cube):
            faces = [face for a, b, c, d in box for face in ((a, b, c), (a, c, d))]

        class Lidless(Cube):
            faces = Box.faces[:-2]

        for mesh in (Said(), Silent(), Lidless(4)):
            manager = CollisionManager()
            manager.add_object("hole", mesh)
            self.assertAlmostEqual(manager.min_distance_single(self.cube), 1.5 if mesh.__class__ is Lidless else 0.5, delta=1e-8)
        manager = CollisionManager(parts=lambda mesh: self.fail("a box is its hull"))
        manager.add_object("box", Box(4))
        with self.assertRaises(NotImplementedError):
            manager.min_distance_single(self.cube, shift(9), return_data=True)[1].index("box")

    def test_without_faces(self):
        mesh = Cube(1)
        mesh.is_convex = False
        with self.assertWarnsRegex(UserWarning, "no faces"):
            self.manager.add_object("hollow", mesh)
        split = CollisionManager(parts=lambda mesh: [Cube(1), Cube(2)])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            split.add_object("halves", mesh)
        self.assertAlmostEqual(split.min_distance_single(Cube(1), shift(3)), 1.5, delta=1e-8)
        with self.assertRaises(ovoid.Error):
            self.manager.add_object("big", self.cube, [[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 0], [0, 0, 0, 1]])


if __name__ == "__main__":
    common.main()
