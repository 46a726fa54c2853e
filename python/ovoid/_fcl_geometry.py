"""The geometries, transforms and objects of python-fcl, for ovoid.fcl."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from . import Pose, Shape, Solid
from ._fcl_data import NODE_TYPE, OBJECT_TYPE, Array

# How far a cylinder's prism and a cone's pyramid may be from it, in radii.
_ROUND_TOLERANCE = 1e-4


def to_vector(numbers: Any) -> Array:
    """Three numbers, with the words of python-fcl where they are not."""
    vector: Array = np.array(numbers, dtype=float).squeeze()
    if vector.shape != (3,):
        raise ValueError("Translation must be (3,).")
    return vector


class Transform:
    """A rotation (3x3, or a quaternion w x y z) and a translation, either alone, or another Transform."""

    def __init__(self, *args: Any) -> None:
        self._rotation: Array = np.eye(3)
        self._translation: Array = np.zeros(3)
        if len(args) > 2:
            raise ValueError("Too many arguments to Transform().")
        if len(args) == 1 and isinstance(args[0], Transform):
            self._rotation, self._translation = args[0]._rotation.copy(), args[0]._translation.copy()
            return
        if len(args) == 2:
            self.setTranslation(to_vector(args[1]))
        for data in map(np.array, args[:1]):
            if data.shape == (3, 3):
                self.setRotation(data)
            elif data.shape == (4,):
                self.setQuatRotation(data)
            elif data.shape == (3,) and len(args) == 1:
                self.setTranslation(data)
            else:
                raise ValueError("Invalid input to Transform().")

    def getRotation(self) -> Array:
        """The rotation, 3x3."""
        return self._rotation.copy()

    def getTranslation(self) -> Array:
        """The translation."""
        return self._translation.copy()

    def getQuatRotation(self) -> Array:
        """The rotation as w, x, y, z."""
        return np.array(self._pose().wxyz)

    def setRotation(self, R: Any) -> None:
        """Sets the rotation, 3x3."""
        self._rotation = np.array(R, dtype=float).reshape(3, 3)

    def setTranslation(self, T: Any) -> None:
        """Sets the translation."""
        self._translation = to_vector(T)

    def setQuatRotation(self, q: Any) -> None:
        """Sets the rotation by w, x, y, z."""
        self._rotation = np.array(Pose.from_quaternion((0, 0, 0), wxyz=np.array(q, dtype=float)).matrix)[:3, :3]

    def _pose(self) -> Pose:
        return Pose.from_rotation(self._translation, self._rotation)


class CollisionGeometry:
    """The base of all geometries. Its body of ovoid is made when it is first asked about, and anew after a change."""

    _node_type: int | None = None
    _object_type = OBJECT_TYPE.OT_GEOM

    def __init__(self) -> None:
        self._body: Shape | Solid | None = None

    def __setattr__(self, name: str, value: Any) -> None:
        if name != "_body":
            super().__setattr__("_body", None)
        super().__setattr__(name, value)

    def getNodeType(self) -> int | None:
        """One of NODE_TYPE."""
        return self._node_type

    def computeLocalAABB(self) -> None:
        """Does nothing: boxes are computed where they are used."""

    @property
    def aabb_center(self) -> Array:
        """The centre of the box around the geometry."""
        low, high = self._box()
        return (low + high) / 2

    def _make(self) -> Shape | Solid:
        raise NotImplementedError(f"{type(self).__name__} has no body of ovoid")

    def _get_body(self) -> Shape | Solid:
        if self._body is None:
            self._body = self._make()
        return self._body

    def _box(self) -> tuple[Array, Array]:
        # The box of the vertices, and what the body has around them.
        body = self._get_body()
        around = body.radius + body.allowance[0] if isinstance(body, Shape) else 0
        return np.array(body.bounds[0], dtype=float) - around, np.array(body.bounds[1], dtype=float) + around

    def _support(self, n: Array) -> Array:
        """The farthest point along a unit direction."""
        points = np.asarray(self._get_body().vertices)
        return np.array(points[np.argmax(points @ n)])


class Box(CollisionGeometry):
    """A box by its sides."""

    _node_type = NODE_TYPE.GEOM_BOX

    def __init__(self, x: float, y: float, z: float) -> None:
        super().__init__()
        self.side = np.array([x, y, z], dtype=float)

    def _make(self) -> Shape:
        return Shape.box(self.side / 2)


class Sphere(CollisionGeometry):
    """A sphere."""

    _node_type = NODE_TYPE.GEOM_SPHERE

    def __init__(self, radius: float) -> None:
        super().__init__()
        self.radius = float(radius)

    def _make(self) -> Shape:
        return Shape.sphere(self.radius)

    def _support(self, n: Array) -> Array:
        return n * self.radius


class Ellipsoid(CollisionGeometry):
    """An ellipsoid by its half axes."""

    _node_type = NODE_TYPE.GEOM_ELLIPSOID

    def __init__(self, a: float, b: float, c: float) -> None:
        super().__init__()
        self.radii = np.array([a, b, c], dtype=float)

    def _make(self) -> Shape:
        return Shape.ellipsoid(self.radii)

    def _support(self, n: Array) -> Array:
        scaled = self.radii * n
        return np.array(self.radii * scaled / np.linalg.norm(scaled))


class _Round(CollisionGeometry):
    def __init__(self, radius: float, lz: float) -> None:
        super().__init__()
        self.radius = float(radius)
        self.lz = float(lz)

    def _on_circle(self, n: Array, z: float) -> Array:
        across = math.hypot(n[0], n[1])
        return np.array([self.radius * n[0] / across, self.radius * n[1] / across, z] if across > 0 else [0, 0, z])


class Capsule(_Round):
    """A capsule along z; lz is the length of its segment."""

    _node_type = NODE_TYPE.GEOM_CAPSULE

    def _make(self) -> Shape:
        return Shape.capsule(self.radius, self.lz / 2)

    def _support(self, n: Array) -> Array:
        end: Array = np.array([0, 0, math.copysign(self.lz / 2, n[2])])
        return n * self.radius + end


class Cone(_Round):
    """A cone along z with its apex at lz / 2."""

    _node_type = NODE_TYPE.GEOM_CONE

    def _make(self) -> Shape:
        return Shape.cone(self.radius, self.lz / 2, self.radius * _ROUND_TOLERANCE)

    def _support(self, n: Array) -> Array:
        apex: Array = np.array([0, 0, self.lz / 2])
        base = self._on_circle(n, -self.lz / 2)
        return base if base @ n > apex @ n else apex


class Cylinder(_Round):
    """A cylinder along z."""

    _node_type = NODE_TYPE.GEOM_CYLINDER

    def _make(self) -> Shape:
        return Shape.cylinder(self.radius, self.lz / 2, self.radius * _ROUND_TOLERANCE)

    def _support(self, n: Array) -> Array:
        return self._on_circle(n, math.copysign(self.lz / 2, n[2]))


class TriangleP(CollisionGeometry):
    """A triangle."""

    _node_type = NODE_TYPE.GEOM_TRIANGLE

    def __init__(self, a: Any, b: Any, c: Any) -> None:
        super().__init__()
        self.a, self.b, self.c = to_vector(a), to_vector(b), to_vector(c)

    def _make(self) -> Shape:
        return Shape.from_points([self.a, self.b, self.c])


class Convex(CollisionGeometry):
    """The hull of vertices; the faces are kept for their number alone."""

    _node_type = NODE_TYPE.GEOM_CONVEX

    def __init__(self, vertices: Any, num_faces: int, faces: Any) -> None:
        super().__init__()
        self._vertices = np.array(vertices, dtype=float)
        self.num_faces = int(num_faces)

    def _make(self) -> Shape:
        return Shape.from_points(self._vertices)


class _Flat(CollisionGeometry):
    def __init__(self, n: Any, d: float) -> None:
        super().__init__()
        self.n = np.array(n, dtype=float)
        self.d = float(d)

    def _box(self) -> tuple[Array, Array]:
        return np.full(3, -np.inf), np.full(3, np.inf)


class Halfspace(_Flat):
    """The points with n x <= d."""

    _node_type = NODE_TYPE.GEOM_HALFSPACE


class Plane(_Flat):
    """The points with n x = d."""

    _node_type = NODE_TYPE.GEOM_PLANE


class BVHModel(CollisionGeometry):
    """A surface of triangles: beginModel, addSubModel, addVertex, addTriangle, endModel."""

    _node_type = NODE_TYPE.BV_OBBRSS
    _object_type = OBJECT_TYPE.OT_BVH

    def __init__(self) -> None:
        super().__init__()
        self._points: list[Array] = []
        self._triangles: list[npt.NDArray[np.int64]] = []
        self._is_building = False

    def num_tris_(self) -> int:
        """The number of triangles."""
        return sum(map(len, self._triangles))

    def beginModel(self, num_tris_: int = 0, num_vertices_: int = 0) -> bool:
        """Starts a model; the numbers have no effect."""
        self._points, self._triangles, self._is_building = [], [], True
        return True

    def addVertex(self, x: float, y: float, z: float) -> bool:
        """Adds a point."""
        return self._add([[x, y, z]], np.zeros((0, 3), dtype=np.uint32))

    def addTriangle(self, v1: Any, v2: Any, v3: Any) -> bool:
        """Adds a triangle with three points of its own."""
        return self._add([v1, v2, v3], [[0, 1, 2]])

    def addSubModel(self, verts: Any, triangles: Any) -> bool:
        """Adds points and triangles of these points."""
        return self._add(verts, triangles)

    def endModel(self) -> bool:
        """Ends a model."""
        if not self._is_building:
            raise ValueError("BVH construction does not follow correct sequence")
        if not self._points:
            raise ValueError("BVH geometry is not prepared")
        self._is_building = False
        return True

    def _add(self, points: Any, triangles: Any) -> bool:
        if not self._is_building:
            raise ValueError("BVH construction does not follow correct sequence")
        first = sum(map(len, self._points))
        self._points.append(np.array(points, dtype=float).reshape(-1, 3))
        self._triangles.append(np.array(triangles, dtype=np.int64).reshape(-1, 3) + first)
        return True

    def _make(self) -> Solid:
        points, triangles = np.concatenate(self._points), np.concatenate(self._triangles)
        solid = Solid.from_triangles(points, triangles)
        # FCL's meshes have no inside: of a closed one a triangle is turned over, so that ovoid's solid has none either.
        for i in range(len(triangles)):
            if not solid.is_closed:
                break
            triangles[i] = triangles[i][[0, 2, 1]]
            solid = Solid.from_triangles(points, triangles)
        return solid


class OcTree(CollisionGeometry):
    """Octrees are not answered."""

    def __init__(self, r: float, data: Any) -> None:
        raise NotImplementedError("ovoid.fcl has no octrees; python-fcl has")


class CollisionObject:
    """A geometry at a transform."""

    def __init__(self, geom: CollisionGeometry | None = None, tf: Transform | None = None, _no_instance: bool = False) -> None:
        if geom is None or geom.getNodeType() is None:
            raise ValueError("an object needs a geometry")
        self._geometry = geom
        self._transform = Transform(tf) if tf is not None else Transform()
        self._kept_box: tuple[Shape | Solid | None, tuple[Array, Array]] | None = None

    def getObjectType(self) -> int:
        """One of OBJECT_TYPE."""
        return self._geometry._object_type

    def getNodeType(self) -> int | None:
        """One of NODE_TYPE."""
        return self._geometry.getNodeType()

    def getTranslation(self) -> Array:
        """The translation."""
        return self._transform.getTranslation()

    def setTranslation(self, vec: Any) -> None:
        """Sets the translation."""
        self._transform.setTranslation(vec)
        self._kept_box = None

    def getRotation(self) -> Array:
        """The rotation, 3x3."""
        return self._transform.getRotation()

    def setRotation(self, mat: Any) -> None:
        """Sets the rotation, 3x3."""
        self._transform.setRotation(mat)
        self._kept_box = None

    def getQuatRotation(self) -> Array:
        """The rotation as w, x, y, z."""
        return self._transform.getQuatRotation()

    def setQuatRotation(self, q: Any) -> None:
        """Sets the rotation by w, x, y, z."""
        self._transform.setQuatRotation(q)
        self._kept_box = None

    def getTransform(self) -> Transform:
        """A copy of the transform."""
        return Transform(self._transform)

    def setTransform(self, tf: Transform) -> None:
        """Sets the transform."""
        self._transform = Transform(tf)
        self._kept_box = None

    def isOccupied(self) -> bool:
        """Every object is."""
        return True

    def isFree(self) -> bool:
        """No object is."""
        return False

    def isUncertain(self) -> bool:
        """No object is."""
        return False

    def _aabb(self) -> tuple[Array, Array]:
        """The box in the world. It is kept until the transform or the body changes: managers ask again at each update."""
        if self._kept_box is None or self._kept_box[0] is not self._geometry._body:
            box = self._compute_box()
            self._kept_box = self._geometry._body, box
        return self._kept_box[1]

    def _compute_box(self) -> tuple[Array, Array]:
        low, high = self._geometry._box()
        if not np.all(np.isfinite(low)):
            return low, high
        center = self._transform._rotation @ ((low + high) / 2) + self._transform._translation
        half = np.abs(self._transform._rotation) @ ((high - low) / 2) * (1 + 1e-9)
        return center - half, center + half

