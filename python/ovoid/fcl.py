"""python-fcl's module, answered by ovoid: sys.modules["fcl"] = ovoid.fcl lets trimesh.collision and other scripts run as they are.

The names, arguments and results are python-fcl's; NumPy is needed. What differs:

- geometries are the bodies of <ovoid/fcl.hpp>: a BVHModel is a surface, cylinders, cones and ellipsoids have allowances;
- two shapes have one contact, the deepest; a mesh has one for each triangle, or pair of triangles, that touches;
- the signed distance of a mesh is minus the length of a translation that is proven to part the bodies;
- octrees, cost sources and spline motions are refused, and so are two geometries without an end (Halfspace, Plane).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np

import ovoid

from ._fcl_data import (
    NODE_TYPE,
    OBJECT_TYPE,
    Array,
    CCDMotionType,
    CCDSolverType,
    CollisionData,
    CollisionRequest,
    CollisionResult,
    Contact,
    ContinuousCollisionRequest,
    ContinuousCollisionResult,
    CostSource,
    DistanceData,
    DistanceRequest,
    DistanceResult,
    GJKSolverType,
)
from ._fcl_geometry import (
    Box,
    BVHModel,
    Capsule,
    CollisionGeometry,
    CollisionObject,
    Cone,
    Convex,
    Cylinder,
    Ellipsoid,
    Halfspace,
    OcTree,
    Plane,
    Sphere,
    Transform,
    TriangleP,
    _Flat,
)

__all__ = [
    "NODE_TYPE", "OBJECT_TYPE", "BVHModel", "Box", "CCDMotionType", "CCDSolverType", "Capsule", "CollisionData", "CollisionGeometry",
    "CollisionObject", "CollisionRequest", "CollisionResult", "Cone", "Contact", "ContinuousCollisionRequest", "ContinuousCollisionResult",
    "Convex", "CostSource", "Cylinder", "DistanceData", "DistanceRequest", "DistanceResult", "DynamicAABBTreeCollisionManager", "Ellipsoid",
    "GJKSolverType", "Halfspace", "OcTree", "Plane", "Sphere", "Transform", "TriangleP", "collide", "continuousCollide",
    "defaultCollisionCallback", "defaultDistanceCallback", "distance",
]  # fmt: skip


class _Touch(NamedTuple):
    """Where two bodies are nearest, or overlap: normal from the first to the second."""

    distance: float
    point_a: Array
    point_b: Array
    normal: Array
    part_a: int = -1
    part_b: int = -1


def collide(
    o1: CollisionObject, o2: CollisionObject, request: CollisionRequest | None = None, result: CollisionResult | None = None
) -> int:
    """Adds the contacts of two objects to the result; the number of new ones."""
    request = request or CollisionRequest()
    result = result if result is not None else CollisionResult()
    if request.enable_cost:
        raise ValueError("ovoid.fcl computes no cost sources: set enable_cost to False")
    count = 0
    for touch in _find_touches(o1, o2, request):
        if count == request.num_max_contacts:
            break
        contact = Contact()
        contact.o1, contact.o2, contact.b1, contact.b2 = o1._geometry, o2._geometry, touch.part_a, touch.part_b
        if request.enable_contact:
            contact.pos, contact.normal = (touch.point_a + touch.point_b) / 2, touch.normal
            contact.penetration_depth = max(0.0, -touch.distance)
        result.contacts.append(contact)
        count += 1
    result.is_collision = result.is_collision or count > 0
    return count


def distance(
    o1: CollisionObject, o2: CollisionObject, request: DistanceRequest | None = None, result: DistanceResult | None = None
) -> float:
    """The distance of two objects; of an overlap -1 (of two meshes 0), or with enable_signed_distance below 0."""
    request = request or DistanceRequest()
    result = result if result is not None else DistanceResult()
    touch = _find_nearest(o1, o2, request.enable_signed_distance)
    least = touch.distance
    if least < 0 and not request.enable_signed_distance:
        least = 0.0 if _is_mesh(o1) and _is_mesh(o2) else -1.0
    if result.min_distance > least:
        result.min_distance = least
        result.nearest_points = [touch.point_a, touch.point_b]
        result.o1, result.o2, result.b1, result.b2 = o1._geometry, o2._geometry, touch.part_a, touch.part_b
    return least


def continuousCollide(
    o1: CollisionObject,
    tf1_end: Transform,
    o2: CollisionObject,
    tf2_end: Transform,
    request: ContinuousCollisionRequest | None = None,
    result: ContinuousCollisionResult | None = None,
) -> float:
    """The first time of contact from 0 to 1, or 1 where the whole motion is proven free."""
    request = request or ContinuousCollisionRequest()
    result = result if result is not None else ContinuousCollisionResult()
    motions = [_make_motion(o._transform, end, request.ccd_motion_type) for o, end in ((o1, tf1_end), (o2, tf2_end))]
    impact = ovoid.find_impact(o1._geometry._get_body(), o2._geometry._get_body(), *motions, end=1, tolerance=min(1e-6, max(1e-12, request.toc_err)))
    is_hit = impact.status != ovoid.ImpactStatus.FREE
    time = 1.0 if not is_hit else impact.hit_at if impact.status == ovoid.ImpactStatus.HIT else impact.free_until
    result.is_collide = result.is_collide or is_hit
    result.time_of_contact = min(result.time_of_contact, time)
    return time


def defaultCollisionCallback(o1: CollisionObject, o2: CollisionObject, cdata: CollisionData) -> bool:
    """For managers: adds contacts until there are as many as wanted."""
    if not cdata.done:
        collide(o1, o2, cdata.request, cdata.result)
        cdata.done = cdata.result.is_collision and len(cdata.result.contacts) >= cdata.request.num_max_contacts
    return cdata.done


def defaultDistanceCallback(o1: CollisionObject, o2: CollisionObject, cdata: DistanceData) -> tuple[bool, float]:
    """For managers: keeps the smallest distance; an overlap ends the search."""
    if cdata.done:
        return True, cdata.result.min_distance
    distance(o1, o2, cdata.request, cdata.result)
    return cdata.result.min_distance <= 0, cdata.result.min_distance


class DynamicAABBTreeCollisionManager:
    """Objects, and callbacks for the pairs whose boxes meet, or may be the nearest."""

    def __init__(self) -> None:
        self._objects: list[CollisionObject] = []
        self._boxes: dict[int, tuple[Array, Array]] = {}

    def registerObjects(self, other_objs: Iterable[CollisionObject]) -> None:
        """Adds objects."""
        for obj in other_objs:
            self.registerObject(obj)

    def registerObject(self, obj: CollisionObject) -> None:
        """Adds an object."""
        self._objects.append(obj)
        self._boxes[id(obj)] = obj._aabb()

    def unregisterObject(self, obj: CollisionObject) -> None:
        """Removes an object, if it is there."""
        if obj in self._objects:
            self._objects.remove(obj)
            self._boxes.pop(id(obj), None)

    def setup(self) -> None:
        """Takes the objects where they are."""
        self.update()

    def update(self, arg: Any = None) -> None:
        """Takes all objects where they are now, or the one, or the ones of a list."""
        for obj in self._objects if arg is None else arg if hasattr(arg, "__len__") else [arg]:
            self._boxes[id(obj)] = obj._aabb()

    def getObjects(self) -> list[CollisionObject]:
        """The objects."""
        return list(self._objects)

    def collide(self, *args: Any) -> None:
        """collide(data, callback), collide(object or manager, data, callback): callback(o1, o2, data) returns whether to stop."""
        pairs, data, callback = self._find_pairs(args, (0.0,))
        for _, a, b in pairs:
            if callback(a, b, data):
                break

    def distance(self, *args: Any) -> None:
        """As collide; callback(o1, o2, data) returns whether to stop, and the smallest distance so far."""
        pairs, data, callback = self._find_pairs(args, _REACHES)
        least = np.inf
        for gap, a, b in pairs:
            if gap > max(least, 0):
                break
            is_done, least = callback(a, b, data)
            if is_done:
                break

    def clear(self) -> None:
        """Removes all objects."""
        self._objects.clear()
        self._boxes.clear()

    def empty(self) -> bool:
        """Are there no objects?"""
        return not self._objects

    def size(self) -> int:
        """The number of objects."""
        return len(self._objects)

    def _get_rows(self) -> list[tuple[CollisionObject, tuple[Array, Array]]]:
        return [(obj, self._boxes[id(obj)]) for obj in self._objects]

    def _find_pairs(
        self, args: tuple[Any, ...], reaches: Iterable[float]
    ) -> tuple[Iterator[tuple[float, CollisionObject, CollisionObject]], Any, Callable[..., Any]]:
        """The pairs by the distance of their boxes, up to the largest of the reaches, and what came with them."""
        if len(args) not in (2, 3) or not callable(args[-1]):
            raise ValueError("expected (data, callback), (object, data, callback) or (manager, data, callback)")
        mine = self._get_rows()
        if len(args) == 2:
            return _sort_pairs(mine, mine, reaches), args[0], args[1]
        if isinstance(args[0], DynamicAABBTreeCollisionManager):
            return _sort_pairs(mine, args[0]._get_rows(), reaches), args[1], args[2]
        return _sort_pairs([(args[0], args[0]._aabb())], mine, reaches), args[1], args[2]


# How far apart boxes are looked for, in sizes of a box: a search that ends early sees near pairs alone.
_REACHES = (0.0, *(2.0**k for k in range(-1, 12)), np.inf)
# The most pairs whose boxes are compared at once.
_BLOCK = 1 << 20


def _sort_pairs(first: list[Any], second: list[Any], reaches: Iterable[float]) -> Iterator[tuple[float, CollisionObject, CollisionObject]]:
    """The pairs by the distance of their boxes, ring by ring. The same list twice: each two objects once."""
    if not first or not second:
        return
    boxes_a, boxes_b = _Boxes(first), _Boxes(second)
    size, least = boxes_b.get_size(), -np.inf
    for reach in reaches:
        ring = list(boxes_a.find_near(boxes_b, least, reach * size if reach > 0 else 0.0, first is second))
        least = reach * size if reach > 0 else 0.0
        i, j, gaps = (np.concatenate([part[k] for part in ring]) for k in range(3))
        for at in np.lexsort((j, i, gaps)).tolist():
            yield float(gaps[at]), first[i[at]][0], second[j[at]][0]


class _Boxes:
    """Boxes of rows, for searches along the x axis: those that start within a range of it are neighbours in `order`."""

    def __init__(self, rows: list[Any]) -> None:
        self.low, self.high = (np.array([row[1][k] for row in rows]) for k in (0, 1))
        self.order = np.argsort(self.low[:, 0], kind="stable")
        self.starts = self.low[self.order, 0]
        self.longest = float((self.high - self.low)[:, 0].max())

    def get_size(self) -> float:
        """A length for reaches: the mean of the finite boxes' longest sides."""
        sides = (self.high - self.low).max(axis=1)
        sides = sides[np.isfinite(sides)]
        return float(sides.mean()) if len(sides) and sides.max() > 0 else 1.0

    def find_near(self, other: _Boxes, least: float, most: float, is_same: bool) -> Iterator[tuple[Any, Any, Any]]:
        """Rows, rows of the other and distances, for distances above `least` up to `most`, in blocks of few pairs."""
        begin = np.searchsorted(other.starts, self.low[:, 0] - most - other.longest, "left")
        counts = np.searchsorted(other.starts, self.high[:, 0] + most, "right") - begin
        sums = np.concatenate([[0], np.cumsum(counts)])
        row = 0
        while row < len(counts):
            end = max(row + 1, int(np.searchsorted(sums, sums[row] + _BLOCK, "right")) - 1)
            i = np.repeat(np.arange(row, end), counts[row:end])
            j = other.order[np.arange(sums[row], sums[end]) - np.repeat(sums[row:end] - begin[row:end], counts[row:end])]
            row = end
            if is_same:
                i, j = i[i < j], j[i < j]
            apart = np.maximum(self.low[i] - other.high[j], other.low[j] - self.high[i])
            gaps = np.linalg.norm(np.maximum(apart, 0), axis=1)
            is_wanted = (gaps > least) & (gaps <= most)
            yield i[is_wanted], j[is_wanted], gaps[is_wanted]


def _is_mesh(o: CollisionObject) -> bool:
    return o.getObjectType() == OBJECT_TYPE.OT_BVH


def _is_hit(answer: Any) -> bool:
    """A sign that is not proven is that of the bracket's middle."""
    if answer.status == ovoid.Status.UNDECIDED:
        return not answer.lower + answer.upper > 0
    return bool(answer.status != ovoid.Status.SEPARATED)


def _find_touches(o1: CollisionObject, o2: CollisionObject, request: CollisionRequest) -> Iterator[_Touch]:
    """The contacts: of a mesh, if more than one is wanted, those of all its triangles that touch."""
    if isinstance(o1._geometry, _Flat) or isinstance(o2._geometry, _Flat):
        touch = _ask_flat(o1, o2)
        if touch.distance <= 0:
            yield touch
        return
    a, b, pose_a, pose_b = o1._geometry._get_body(), o2._geometry._get_body(), o1._transform._pose(), o2._transform._pose()
    if not (_is_mesh(o1) or _is_mesh(o2)):
        answer = (ovoid.depth if request.enable_contact else ovoid.collide)(a, b, pose_a, pose_b)
        if _is_hit(answer):
            yield _make_touch(answer, -1, -1)
        return
    answer = ovoid.collide(a, b, pose_a, pose_b)
    if not _is_hit(answer):
        return
    first = (answer.part_a if _is_mesh(o1) else 0, answer.part_b if _is_mesh(o2) else 0)
    others = [] if request.num_max_contacts == 1 else [pair for pair in _find_boxes(o1, o2) if pair != first]
    yield from _ask_parts(o1, o2, [first, *others])


def _ask_parts(o1: CollisionObject, o2: CollisionObject, pairs: list[tuple[int, int]]) -> Iterator[_Touch]:
    """The contacts of pairs of parts, of which the first one is known to touch."""
    parts_a, parts_b = sorted({i for i, _ in pairs}), sorted({j for _, j in pairs})
    rows = {i: k for k, i in enumerate(parts_a)}, {j: k + len(parts_a) for k, j in enumerate(parts_b)}
    shapes = [_get_part(o1, i) for i in parts_a] + [_get_part(o2, j) for j in parts_b]
    poses = [o1._transform._pose()] * len(parts_a) + [o2._transform._pose()] * len(parts_b)
    couples = np.array([(rows[0][i], rows[1][j]) for i, j in pairs], dtype=np.uint32)
    verdicts, witnesses = ovoid.depth_batch(ovoid.Bodies(shapes, poses), couples, witnesses=True)
    middles = (verdicts["lower"] + verdicts["upper"]) / 2
    is_open = verdicts["status"] == int(ovoid.Status.UNDECIDED)
    hits = np.where(is_open, ~(middles > 0), verdicts["status"] != int(ovoid.Status.SEPARATED))
    hits[0] = True
    for k in np.flatnonzero(hits).tolist():
        i, j = pairs[k]
        point_a, point_b, normal = (np.array(witnesses[name][k].tolist()) for name in ("point_a", "point_b", "normal"))
        yield _Touch(float(middles[k]), point_a, point_b, normal, i if _is_mesh(o1) else -1, j if _is_mesh(o2) else -1)


def _make_touch(answer: Any, part_a: int, part_b: int) -> _Touch:
    middle = (answer.lower + answer.upper) / 2
    return _Touch(middle, np.array(answer.point_a), np.array(answer.point_b), np.array(answer.normal), part_a, part_b)


def _find_nearest(o1: CollisionObject, o2: CollisionObject, is_signed: bool) -> _Touch:
    if isinstance(o1._geometry, _Flat) or isinstance(o2._geometry, _Flat):
        return _ask_flat(o1, o2)
    a, b, pose_a, pose_b = o1._geometry._get_body(), o2._geometry._get_body(), o1._transform._pose(), o2._transform._pose()
    has_mesh = _is_mesh(o1) or _is_mesh(o2)
    answer = (ovoid.depth if is_signed and not has_mesh else ovoid.distance)(a, b, pose_a, pose_b)
    touch = _make_touch(answer, answer.part_a if _is_mesh(o1) else -1, answer.part_b if _is_mesh(o2) else -1)
    if not _is_hit(answer) or (is_signed and not has_mesh):
        return touch
    return touch._replace(distance=min(answer.lower, -0.0) if is_signed and has_mesh else -1.0)


def _get_part(o: CollisionObject, i: int) -> Any:
    """A shape, or triangle i of a mesh as a shape, which is kept with the mesh."""
    body: Any = o._geometry._get_body()
    if not _is_mesh(o):
        return body
    kept = o._geometry.__dict__.setdefault("_parts", (body, {}))
    if kept[0] is not body:
        kept = o._geometry.__dict__["_parts"] = (body, {})
    if i not in kept[1]:
        kept[1][i] = ovoid.Shape.from_points(np.asarray(body.vertices)[np.asarray(body.faces)[i]])
    return kept[1][i]


def _make_boxes(o: CollisionObject) -> tuple[Array, Array]:
    """The boxes of the triangles of a mesh, or of the object, in the world."""
    if not _is_mesh(o):
        low, high = o._aabb()
        return low[None], high[None]
    body: Any = o._geometry._get_body()
    points = np.asarray(body.vertices) @ o._transform._rotation.T + o._transform._translation
    corners = points[np.asarray(body.faces)]
    slack = 1e-12 * (1 + np.abs(points).max())
    return corners.min(axis=1) - slack, corners.max(axis=1) + slack


def _find_boxes(o1: CollisionObject, o2: CollisionObject) -> Iterator[tuple[int, int]]:
    """The pairs of triangles (0: the object) whose boxes meet."""
    (low_a, high_a), (low_b, high_b) = _make_boxes(o1), _make_boxes(o2)
    near = np.flatnonzero(np.all((low_a <= high_b.max(axis=0)) & (high_a >= low_b.min(axis=0)), axis=1))
    for i in near.tolist():
        for j in np.flatnonzero(np.all((low_b <= high_a[i]) & (high_b >= low_a[i]), axis=1)).tolist():
            yield i, j


def _ask_flat(o1: CollisionObject, o2: CollisionObject) -> _Touch:
    """A halfspace or plane and another geometry, in closed form."""
    is_first = isinstance(o1._geometry, _Flat)
    flat, other = (o1, o2) if is_first else (o2, o1)
    if isinstance(other._geometry, _Flat):
        raise ValueError("ovoid.fcl does not compare two geometries without an end (Halfspace, Plane)")
    geometry: Any = flat._geometry
    length = float(np.linalg.norm(geometry.n))
    n = flat._transform._rotation @ geometry.n / length
    d = geometry.d / length + float(n @ flat._transform._translation)
    turn, at = other._transform._rotation, other._transform._translation
    low = turn @ other._geometry._support(turn.T @ -n) + at
    height = float(n @ low) - d
    point, signed, normal = low, height, -n
    if isinstance(geometry, Plane):
        high = turn @ other._geometry._support(turn.T @ n) + at
        top = float(n @ high) - d
        if height <= 0 and (top < 0 or top < -height):
            point, signed, normal = high, -top, n
    on_plane = point - n * (float(n @ point) - d)
    if is_first:
        return _Touch(signed, on_plane, point, -normal)
    return _Touch(signed, point, on_plane, normal)


def _make_motion(begin: Transform, end: Transform, kind: int) -> ovoid.Motion:
    start, stop = begin._pose(), end._pose()
    if kind == CCDMotionType.CCDM_TRANS:
        return ovoid.Motion.poses(start, ovoid.Pose.from_rotation(end._translation, begin._rotation))
    if kind == CCDMotionType.CCDM_LINEAR:
        return ovoid.Motion.poses(start, stop)
    if kind != CCDMotionType.CCDM_SCREW:
        raise ValueError("ovoid.fcl has no spline motions: take CCDM_LINEAR or CCDM_SCREW")
    turn = (ovoid.Pose.from_rotation((0, 0, 0), end._rotation) @ ovoid.Pose.from_rotation((0, 0, 0), begin._rotation).inverse()).wxyz
    if turn[0] < 0:
        turn = tuple(-x for x in turn)  # type: ignore[assignment]
    angle = 2 * float(np.arctan2(np.linalg.norm(turn[1:]), turn[0]))
    if angle < 1e-10:
        return ovoid.Motion.poses(start, stop)
    axis = np.array(turn[1:]) / np.linalg.norm(turn[1:])
    way = end._translation - begin._translation
    to_axis = (way - axis * (axis @ way) + np.cross(axis, way) / np.tan(angle / 2)) / 2
    return ovoid.Motion.velocity(start, axis * (axis @ way), axis * angle, 1, pivot=begin._rotation.T @ to_axis)
