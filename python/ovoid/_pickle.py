"""How what is a value is pickled and copied, and why the rest is not: one table, which copyreg hands to pickle and copy.

The state of a result is the bytes of its C values. It goes with a digest: bytes that were altered, or that a library with
another layout wrote, are refused.
"""

from __future__ import annotations

import copyreg
import hashlib
import sys
from typing import Any

from . import _ovoid
from ._enums import Code, Error


def _compute_digest(name: str, state: bytes) -> bytes:
    layout = f"{name} {_ovoid.__version__} {sys.byteorder} {sys.maxsize}".encode()
    return hashlib.blake2b(layout + state, digest_size=16).digest()


def make_from_state(name: str, objects: tuple[Any, ...], state: bytes, digest: bytes) -> Any:
    """The result of that class about these objects."""
    if digest != _compute_digest(name, state):
        raise Error(f"this pickle of an ovoid.{name} was altered, or another version of ovoid wrote it", Code.FORMAT)
    return _ovoid._make_from_state(getattr(_ovoid, name), objects, state)


def _reduce_state(value: Any) -> tuple[Any, ...]:
    name = type(value).__name__
    objects, state = _ovoid._get_state(value)
    return make_from_state, (name, objects, state, _compute_digest(name, state))


def make_robot(parts: tuple[Any, ...], name: str | None, facts: dict[str, Any]) -> Any:
    """A Robot of its links, joints, elements and disabled pairs, and what its files said beside."""
    robot = _ovoid.Robot(*parts, name=name)
    robot._set_facts(facts)
    return robot


def _reduce_robot(robot: Any) -> tuple[Any, ...]:
    parts = (robot.links, robot.joints, robot.elements, robot.disabled)
    return make_robot, (parts, robot.name, robot._get_facts())


def make_world(options: dict[str, Any], bodies: list[tuple[Any, ...]], ignored: list[tuple[int, int]],
               materials: list[tuple[int, tuple[float, ...]]]) -> Any:
    """A World with these bodies, (body, pose, group, mask) each; pairs of these that are ignored; materials, with their body."""
    world = _ovoid.World(**options)
    ids = [world.add(body, pose, group=group, mask=mask) for body, pose, group, mask in bodies]
    for a, b in ignored:
        world.set_ignored(ids[a], ids[b])
    for a, (margin, friction, restitution) in materials:
        world.set_material(ids[a], margin=margin, friction=friction, restitution=restitution)
    return world


def _reduce_world(world: Any) -> tuple[Any, ...]:
    options, bodies, ids = world._get_state()
    again, ids = make_world(options, bodies, [], []), ids.tolist()
    if again.ids().tolist() != ids:
        raise TypeError("this World cannot be pickled or copied: bodies were removed from it, so a new World would give other ids")
    pairs = ((a, b) for a in range(len(ids)) for b in range(a + 1, len(ids)))
    ignored = [(a, b) for a, b in pairs if world.is_pair(ids[a], ids[b]) != again.is_pair(ids[a], ids[b])]
    materials = [(a, tuple(world.material(body))) for a, body in enumerate(ids) if any(world.material(body))]
    return make_world, (options, bodies, ignored, materials)


def make_swept(kind: str, sizes: Any, pose: Any, rounding: float) -> Any:
    """The SweptSphere of that constructor."""
    make = getattr(_ovoid.SweptSphere, kind)
    if kind in ("box", "from_points"):
        return make(sizes, pose, rounding=rounding)
    return make(sizes, pose) if kind == "ellipsoid" else make(*sizes, pose)


def _refuse(why: str) -> Any:
    def reduce(value: Any) -> Any:
        raise TypeError(f"an ovoid.{type(value).__name__} cannot be pickled or copied: {why}")
    return reduce


_REDUCERS = {
    "Answer": _reduce_state, "Approach": _reduce_state, "Ellipsoid": _reduce_state, "Gradient": _reduce_state, "Impact": _reduce_state, "Manifold": _reduce_state,
    "Motion": _reduce_state, "RayHit": _reduce_state, "Smooth": _reduce_state, "SmoothValue": _reduce_state,
    "Bodies": lambda bodies: (_ovoid.Bodies, (bodies.shapes, bodies.poses)),
    "Prepared": lambda prepared: (_ovoid.Prepared, (prepared.shape, prepared.pose)),
    "Robot": _reduce_robot,
    "SweptSphere": lambda swept: (make_swept, (swept.kind, swept.sizes, swept.pose, swept.rounding)),
    "World": _reduce_world,
    "Cell": _refuse("it keeps the states of earlier queries; pickle its robot, and make a Cell in the other process"),
    "RobotPath": _refuse("it belongs to its Cell; write its proof to a file with the tool, and read it with cell.read_paths"),
}
for _name, _reducer in _REDUCERS.items():
    if hasattr(_ovoid, _name):
        copyreg.pickle(getattr(_ovoid, _name), _reducer)
