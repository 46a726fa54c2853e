"""What draw() and show() are given: bodies at their poses, the answers that join them, or a robot."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from . import _ovoid
from ._enums import Code, Error
from ._values import Hit

#: Most bodies of which the nearest of each is looked for, as the tool's view does.
FEW = 12

_BODIES = (_ovoid.Shape, _ovoid.Compound, _ovoid.Solid)
_MODELS = tuple(getattr(_ovoid, name) for name in ("Robot", "Cell", "RobotPath") if hasattr(_ovoid, name))


class Placed(NamedTuple):
    """A body that is drawn. name: None where it has none; group: bodies of one group have one colour, 0: its own."""

    name: str | None
    body: Any
    pose: Any
    group: int = 0


class Scene:
    """Bodies, and links (a, b, Answer) between their numbers; or a model, a Robot, a Cell or a RobotPath, with states."""

    def __init__(self) -> None:
        self.bodies: list[Placed] = []
        self.links: list[tuple[int, int, Any]] = []
        self.model: Any = None
        self.states: list[list[float]] = []
        self.names: list[str | None] = []  #: of the states
        self._ends: dict[tuple[int, tuple[float, ...]], int] = {}

    def add(self, body: Any, pose: Any = None, name: str | None = None, group: int = 0) -> int:
        """The number of a body that is added."""
        self.bodies.append(Placed(name, body, _ovoid.Pose(pose), group))
        return len(self.bodies) - 1

    def add_answer(self, answer: Any, name: str | None) -> None:
        """The two bodies, each once at each pose, and what is proven of them."""
        ends = []
        for body, pose, own in ((answer.a, answer.pose_a, "a"), (answer.b, answer.pose_b, "b")):
            key = (id(body), pose.xyz_wxyz)
            if key not in self._ends:
                self._ends[key] = self.add(body, pose, f"{name} {own}" if name else own)
            ends.append(self._ends[key])
        self.links.append((ends[0], ends[1], answer))

    def add_nearest(self) -> None:
        """Links each of few bodies with the nearest one, where nothing is linked."""
        count = len(self.bodies)
        if self.links or not 2 <= count <= FEW:
            return
        answers = {(a, b): ask(self.bodies[a], self.bodies[b]) for a in range(count) for b in range(a + 1, count)}
        lowers: dict[tuple[int, int], float] = {pair: answer.lower for pair, answer in answers.items()}
        nearest = {min((pair for pair in answers if i in pair), key=lowers.__getitem__) for i in range(count)}
        self.links = [(a, b, answers[a, b]) for a, b in sorted(nearest, key=lowers.__getitem__)]


def ask(a: Placed, b: Placed) -> Any:
    """The Answer to the signed distance of two bodies, of those that overlap without Solids to their depth."""
    has_solid = isinstance(a.body, _ovoid.Solid) or isinstance(b.body, _ovoid.Solid)
    return (_ovoid.distance if has_solid else _ovoid.depth)(a.body, b.body, a.pose, b.pose)


# ---- robots

def get_cell(model: Any) -> Any:
    """The Cell of a RobotPath, a Cell itself, of a Robot one without obstacles."""
    return model.cell if hasattr(model, "cell") else model if hasattr(model, "robot") else _ovoid.Cell(model)


def compute_path_state(path: Any, s: float) -> list[float]:
    """The state of a path at s, linear between its states."""
    states: list[list[float]] = path.states.tolist()
    i = min(max(int(s), 0), len(states) - 1)
    after = states[min(i + 1, len(states) - 1)]
    return [q0 + (s - i) * (q1 - q0) for q0, q1 in zip(states[i], after)]


def get_records(array: Any) -> list[dict[str, Any]]:
    """Records as dicts, of NumPy's arrays too."""
    rows: list[Any] = array.tolist()
    return rows if isinstance(array, _ovoid.Array) else [dict(zip(array.dtype.names, row)) for row in rows]


def list_states(states: Any) -> list[Any]:
    """One state or several, by numbers, names or dicts, as a list."""
    if isinstance(states, (str, Mapping)):
        return [states]
    rows: list[Any] = states.tolist() if hasattr(states, "tolist") else list(states)
    return [rows] if rows and not hasattr(rows[0], "__len__") else rows


def add_model(scene: Scene, model: Any) -> None:
    """The bodies of a robot and of its cell at the scene's first state, of a path that hits at the hit; and the nearest pair."""
    cell, robot = get_cell(model), get_cell(model).robot
    q = compute_path_state(model, model.hit_at) if hasattr(model, "hit_at") and model.status == "hit" else scene.states[0]
    poses = [_ovoid.Pose(matrix) for matrix in robot.poses(q).tolist()]
    numbers: dict[tuple[int, int], int] = {}  # by element, or by body
    named: set[int] = set()
    for i, element in enumerate(robot.elements):
        link = robot.links.index(element.link)
        name = None if link in named else element.link
        named.add(link)
        numbers[i, 0] = scene.add(element.solid or element.shape, poses[link] @ element.pose, name, link + 1)
    for i, (key, (body, name, link, pose)) in enumerate(cell._kept.items()):
        group = len(robot.links) + 1 + i if link is None else link + 1
        numbers[-1, key] = scene.add(body, pose if link is None else poses[link] @ pose, name, group)
    for row in get_records(cell.nearest(q, limit_slack=float("inf"))[0]):
        sides = ((-1, row[f"body_{side}"]) if row[f"body_{side}"] else (row[f"element_{side}"], 0) for side in "ab")
        a, b = (numbers[side] for side in sides)
        scene.links.append((a, b, ask(scene.bodies[a], scene.bodies[b])))


# ---- all else

def _add_world(scene: Scene, world: Any) -> None:
    ids = world.ids().tolist()
    numbers = {key: scene.add(world.body(key), world.pose(key), f"body {key}") for key in ids}
    hits: list[Any] = [world.nearest(key) for key in ids] if len(ids) <= FEW else []
    pairs: dict[tuple[int, int], Any] = {}
    for hit in (one for one in hits if one is not None):
        pairs.setdefault((min(hit.a, hit.b), max(hit.a, hit.b)), hit)
    scene.links += [(numbers[hit.a], numbers[hit.b], hit.answer) for hit in pairs.values()]


def _add_bodies(scene: Scene, bodies: Any, name: str | None) -> None:
    for i, (shape, pose) in enumerate(zip(bodies.shapes, bodies.poses)):
        scene.add(shape, pose, f"{name or 'body'} {i}")


def _add_model(scene: Scene, model: Any, states: Any) -> None:
    if scene.model is not None:
        raise Error("one robot is shown at a time", Code.ARGUMENT)
    scene.model = model
    robot = get_cell(model).robot
    given = list_states(model.states if hasattr(model, "hit_at") else robot.default_state() if states is None else states)
    scene.names = [row if isinstance(row, str) else None for row in given]
    scene.states = [robot.q(row) if isinstance(row, (str, Mapping)) else list(map(float, row)) for row in given]
    if not scene.states:
        raise Error("there is no state to show", Code.EMPTY)


def add_item(scene: Scene, item: Any, name: str | None = None) -> None:
    """Adds anything that can be drawn."""
    if isinstance(item, _BODIES):
        scene.add(item, None, name)
    elif isinstance(item, _MODELS):
        _add_model(scene, item, None)
    elif isinstance(item, Hit):
        scene.add_answer(item.answer, name)
    elif isinstance(item, _ovoid.Answer):
        scene.add_answer(item, name)
    elif isinstance(item, _ovoid.Approach):
        scene.add_answer(item.answer, name)
    elif isinstance(item, _ovoid.Impact):
        if item.hit is None and item.free is None:
            raise Error("this Impact has no answer to show: it was refused", Code.ARGUMENT)
        scene.add_answer(item.free if item.hit is None else item.hit, name)
    elif isinstance(item, _ovoid.World):
        _add_world(scene, item)
    elif isinstance(item, _ovoid.Bodies):
        _add_bodies(scene, item, name)
    elif isinstance(item, _ovoid.Prepared):
        scene.add(item.shape, item.pose, name)
    elif isinstance(item, Mapping):
        for key, one in item.items():
            add_item(scene, one, str(key))
    elif isinstance(item, tuple) and len(item) == 2 and isinstance(item[0], _BODIES) and not isinstance(item[1], _BODIES):
        scene.add(item[0], item[1], name)
    elif isinstance(item, tuple) and len(item) == 2 and isinstance(item[0], _MODELS):
        _add_model(scene, item[0], item[1])
    elif isinstance(item, (list, tuple)):
        for one in item:
            add_item(scene, one, name)
    else:
        raise TypeError("what is drawn is a body, (body, pose), an answer, a World, Bodies, a Robot, a Cell, a RobotPath, (cell, states), or "
                        f"a list or a dict by names of these, not {type(item)!r}")


def make_scene(items: tuple[Any, ...]) -> Scene:
    """What the items are; bodies without a name have their numbers, where there are several."""
    if not hasattr(_ovoid, "_draw"):
        raise Error("this build of ovoid draws no pictures and pages: it was built without libovoid_io", Code.FILE)
    scene = Scene()
    for item in items:
        add_item(scene, item)
    if scene.model is not None and scene.bodies:
        raise Error("a robot is shown alone: its obstacles are those of its Cell", Code.ARGUMENT)
    if not scene.bodies and scene.model is None:
        raise Error("there is nothing to show", Code.EMPTY)
    if len(scene.bodies) > 1:
        scene.bodies = [one if one.name else one._replace(name=f"body {i}") for i, one in enumerate(scene.bodies)]
    scene.add_nearest()
    return scene
