"""CollisionManager: the methods of trimesh.collision.CollisionManager, answered by ovoid; trimesh need not be installed.

Objects are anything with .vertices and .faces (a trimesh.Trimesh), or a Shape, Compound or Solid, or a list of convex parts.
trimesh's own manager takes meshes as surfaces, through FCL. So:

- a mesh with .faces is a hull where exact signs say so (Solid.match_hull), whatever its is_convex says; else a Solid, of
  which closed ones have an inside and open ones are surfaces. One without .faces is the hull of its points, with a warning
  where is_convex is False. `parts`, a function of a mesh that is not convex, returns convex meshes to take in its place:
  fewer and faster to ask than many triangles;
- one body inside another is a collision, and every pair that is not proven apart counts as one;
- of bodies that overlap the distance is minus the depth of the deepest pair, where FCL says -1; of Solids minus a way that is
  proven to part them, which need not be the shortest;
- a pair has one contact, the deepest;
- hulls have no faces of the mesh: of these ContactData.index and DistanceData.index raise NotImplementedError.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from . import Compound, Pose, Shape, Solid, Status, World, depth, distance

if TYPE_CHECKING:
    from . import Answer
    from ._types import Body, PoseLike, Vec3

__all__ = ["CollisionManager", "ContactData", "DistanceData"]

_EXTERNAL = "__external"


class _PairData:
    def __init__(self, names: Iterable[str], answer: Answer) -> None:
        self._names = tuple(names)
        self.answer = answer  #: the Answer, which ovoid.verify takes

    @property
    def names(self) -> set[str]:
        """The names of the two objects; of one that is in no manager "__external"."""
        return set(self._names)

    def index(self, name: str) -> int:
        """The face of an object that decides, where it is a Solid."""
        is_first = name == self._names[0]
        if not isinstance(self.answer.a if is_first else self.answer.b, Solid):
            raise NotImplementedError("this body is a hull: it has no face of the mesh to name")
        return self.answer.part_a if is_first else self.answer.part_b


class ContactData(_PairData):
    """Two objects that are not proven apart: names, normal, point, depth."""

    @property
    def normal(self) -> Vec3:
        """Unit normal from the first object to the second, world frame."""
        return self.answer.normal

    @property
    def point(self) -> Vec3:
        """A point between the two witness points, world frame."""
        x, y, z = ((a + b) / 2 for a, b in zip(self.answer.point_a, self.answer.point_b))
        return x, y, z

    @property
    def depth(self) -> float:
        """The penetration depth, at least 0; never below the true one."""
        return max(0.0, -self.answer.lower)


class DistanceData(_PairData):
    """The nearest two objects: names, distance, point."""

    @property
    def distance(self) -> float:
        """The signed distance, never above the true one."""
        return self.answer.lower

    def point(self, name: str) -> Vec3:
        """The nearest point of an object, world frame."""
        return self.answer.point_a if name == self._names[0] else self.answer.point_b


class CollisionManager:
    """Objects by name; whether, where and how far they and others collide."""

    def __init__(self, parts: Callable[[Any], Iterable[Any]] | None = None, threads: int = 1) -> None:
        self._world = World(threads=threads)
        self._ids: dict[str, int] = {}
        self._names: dict[int, str] = {}
        self._parts = parts

    def add_object(self, name: str, mesh: Any, transform: PoseLike = None) -> int:
        """Adds an object, or replaces that of this name. transform: 4x4, rigid."""
        body, pose = self._make_body(mesh), Pose(transform)
        if name in self._ids:
            self.remove_object(name)
        key = self._world.add(body, pose)
        self._ids[name] = key
        self._names[key] = name
        return key

    def remove_object(self, name: str) -> None:
        """Removes an object."""
        key = self._find(name)
        self._world.remove(key)
        del self._ids[name], self._names[key]

    def set_transform(self, name: str, transform: PoseLike) -> None:
        """Moves an object to a rigid 4x4 transform."""
        self._world.move(self._find(name), Pose(transform))

    def in_collision_single(self, mesh: Any, transform: PoseLike = None, return_names: bool = False, return_data: bool = False) -> Any:
        """Does a mesh collide with any object? Also the set of names, and the list of ContactData, where asked for."""
        contacts = self._find_contacts(self._make_body(mesh), Pose(transform), _EXTERNAL)
        names = {name for contact in contacts for name in contact.names - {_EXTERNAL}}
        return _select(bool(contacts), return_names, names, return_data, contacts)

    def in_collision_internal(self, return_names: bool = False, return_data: bool = False) -> Any:
        """Do any two objects collide? Names are sorted pairs."""
        if not return_names and not return_data:
            return self._world.find_any() is not None
        contacts = []
        for row in self._world.contacts("collide").items.tolist():
            a, b = (row["a"], row["b"]) if isinstance(row, dict) else row[:2]
            contacts.append(ContactData((self._names[a], self._names[b]), self._get_depth(a, b)))
        names = {tuple(sorted(contact.names)) for contact in contacts}
        return _select(bool(contacts), return_names, names, return_data, contacts)

    def in_collision_other(self, other_manager: CollisionManager, return_names: bool = False, return_data: bool = False) -> Any:
        """Does any object collide with one of another manager? Names are pairs (own, other's)."""
        contacts = []
        for key, name in other_manager._names.items():
            contacts += self._find_contacts(other_manager._world.body(key), other_manager._world.pose(key), name)
        names = {contact._names[::-1] for contact in contacts}
        return _select(bool(contacts), return_names, names, return_data, contacts)

    def min_distance_single(self, mesh: Any, transform: PoseLike = None, return_name: bool = False, return_data: bool = False) -> Any:
        """The smallest signed distance of a mesh to the objects; the nearest one's name, and DistanceData."""
        data = self._find_nearest(self._make_body(mesh), Pose(transform), _EXTERNAL)
        name = data._names[1] if data else None
        return _select(data.distance if data else float("inf"), return_name, name, return_data, data)

    def min_distance_internal(self, name: str | None = None, return_names: bool = False, return_data: bool = False) -> Any:
        """The smallest signed distance of any two objects, or of the named one to the others."""
        keys = list(self._names) if name is None else [self._find(name)]
        found = None
        for key in keys:
            data = self._find_nearest(self._world.body(key), self._world.pose(key), self._names[key], key)
            if data and (found is None or data.distance < found.distance):
                found = data
        names = tuple(sorted(found.names)) if found else None
        return _select(found.distance if found else float("inf"), return_names, names, return_data, found)

    def min_distance_other(self, other_manager: CollisionManager, return_names: bool = False, return_data: bool = False) -> Any:
        """The smallest signed distance to another manager's objects; names are a pair (own, other's)."""
        found = None
        for key, name in other_manager._names.items():
            data = self._find_nearest(other_manager._world.body(key), other_manager._world.pose(key), name)
            if data and (found is None or data.distance < found.distance):
                found = data
        names = found._names[::-1] if found else None
        return _select(found.distance if found else float("inf"), return_names, names, return_data, found)

    # ---- inside

    def _find(self, name: str) -> int:
        if name not in self._ids:
            raise ValueError(f"{name} is no object of this manager")
        return self._ids[name]

    def _make_body(self, mesh: Any) -> Body:
        if isinstance(mesh, (Shape, Compound, Solid)):
            return mesh
        if isinstance(mesh, (list, tuple)):
            return Compound([self._make_hull(part) for part in mesh])
        solid = Solid.from_mesh(mesh) if hasattr(mesh, "faces") else None
        hull = solid.match_hull() if solid else None
        if hull:
            return hull
        if self._parts is not None and (solid or not getattr(mesh, "is_convex", None)):
            return Compound([self._make_hull(part) for part in self._parts(mesh)])
        if solid:
            return solid
        if not getattr(mesh, "is_convex", True):
            warnings.warn("the mesh is not convex and has no faces: its convex hull is taken", stacklevel=3)
        return self._make_hull(mesh)

    @staticmethod
    def _make_hull(mesh: Any) -> Shape:
        return mesh if isinstance(mesh, Shape) else Shape.hull_of(mesh)

    def _find_contacts(self, body: Body, pose: Pose, name: str) -> list[ContactData]:
        """The contacts of a body that is not in the world; the body is a."""
        contacts = []
        for hit in self._world.overlaps(body, pose):
            answer = _find_depth(body, hit.answer.b, pose, hit.answer.pose_b)
            contacts.append(ContactData((name, self._names[hit.b]), answer))
        return contacts

    def _get_depth(self, a: int, b: int) -> Answer:
        world = self._world
        return _find_depth(world.body(a), world.body(b), world.pose(a), world.pose(b))

    def _find_nearest(self, body: Body, pose: Pose, name: str, key: int | None = None) -> DistanceData | None:
        """The nearest object to a body, or where some overlap the deepest; key: the body's own id, left out."""
        hit = self._world.nearest_to(body, pose) if key is None else self._world.nearest(key)
        if hit is None:
            return None
        if hit.answer.status == Status.SEPARATED:
            return DistanceData((name, self._names[hit.b]), hit.answer)
        deepest = [
            DistanceData((name, self._names[other.b]), _find_depth(body, other.answer.b, pose, other.answer.pose_b))
            for other in self._world.overlaps(body, pose)
            if other.b != key
        ]
        return min(deepest, key=lambda data: data.distance)


def _find_depth(a: Body, b: Body, pose_a: Pose, pose_b: Pose) -> Answer:
    """Of Solids the distance, whose bracket has their depth too."""
    ask = distance if isinstance(a, Solid) or isinstance(b, Solid) else depth
    return ask(a, b, pose_a, pose_b)


def _select(first: object, has_second: bool, second: object, has_third: bool, third: object) -> Any:
    """What a caller asked for: alone, or as a tuple."""
    if not has_second and not has_third:
        return first
    return (first, *([second] if has_second else []), *([third] if has_third else []))
