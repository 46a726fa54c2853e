"""show(): the page of `ovoid ... --html`, one HTML file that shows bodies or a robot and checks their proofs in the browser.

docs/page.md has the format of its data. The page is made of a template, which `make page` builds, or a released package has."""

from __future__ import annotations

import array
import base64
import json
import math
import os
import pathlib
import shutil
import sys
import tempfile
import webbrowser
from typing import TYPE_CHECKING, Any

from . import _ovoid
from ._enums import Code, Error
from ._scene import Scene, compute_path_state, get_cell, get_records, make_scene

if TYPE_CHECKING:
    from ._types import PathLike

_MARK = "<!--ovoid-data-->"
_NO_INDEX = 2**32 - 1
#: As the tool: samples of the clearance a segment and in all, and most pairs whose names are listed.
_SEGMENT, _SAMPLES, _PAIRS = 50, 2001, 20000


# ---- the template

def _find_template() -> pathlib.Path:
    """The file that OVOID_PAGE names; else page.html in the package, beside the tool, in share/ovoid beside the tool or Python."""
    given = os.environ.get("OVOID_PAGE")
    if given:
        return pathlib.Path(given)
    tool = shutil.which("ovoid")
    package = pathlib.Path(__file__).resolve().parent
    folders = [package, package.parent.parent] + ([pathlib.Path(tool).resolve().parent] if tool else []) + [pathlib.Path(sys.prefix) / "bin"]
    places = folders + [folder.parent / "share" / "ovoid" for folder in folders[2:]]
    for place in places:
        if (place / "page.html").is_file():
            return place / "page.html"
    raise Error('there is no template of the page: "make page" in ovoid\'s sources builds it; set the environment variable OVOID_PAGE to '
                f"the file, or copy it to {package / 'page.html'}", Code.FILE)


def _read_template() -> tuple[str, str]:
    """What stands before and behind the data."""
    path = _find_template()
    try:
        parts = path.read_text(encoding="utf-8").split(_MARK)
    except OSError as trouble:
        raise Error(f"the template of the page cannot be read: {trouble}", Code.FILE) from trouble
    if len(parts) != 2:
        raise Error(f"{path} is no template of the page: {_MARK} stands in it {len(parts) - 1} times, and must once", Code.FORMAT)
    return parts[0], parts[1]


# ---- pieces of the data

def _encode(kind: str, numbers: Any) -> str:
    """Base64 of little-endian numbers of a kind of the module array."""
    items = array.array(kind, numbers)
    if sys.byteorder == "big":
        items.byteswap()
    return base64.b64encode(items.tobytes()).decode()


def _flatten(rows: Any) -> list[Any]:
    return [number for row in rows.tolist() for number in row]


def _make_pose(pose: Any) -> dict[str, Any]:
    return {"xyz": pose.xyz, "quat_wxyz": pose.wxyz}


def _clean(value: Any) -> Any:
    """Data for JSON, whose numbers are finite: others are null."""
    if isinstance(value, dict):
        return {key: _clean(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_clean(one) for one in value]
    return value if not isinstance(value, float) or math.isfinite(value) else None


class _Shapes:
    """Each shape once, in the order of their numbers."""

    def __init__(self) -> None:
        self.data: list[dict[str, Any]] = []
        self._numbers: dict[int, int] = {}
        self._kept: list[Any] = []  # so that no other object gets the identity of one of these

    def add(self, shape: Any, solid: Any = None) -> int:
        """The number of a shape, or of the hull of a solid; the hull is made where there is none."""
        key = id(shape if shape is not None else solid)
        if key not in self._numbers:
            self._numbers[key] = len(self.data)
            self._kept.append((shape, solid))
            hull = shape if shape is not None else _ovoid.Shape.from_points(solid.vertices)
            data = {"bytes": base64.b64encode(hull.to_bytes()).decode()}
            if solid is not None:
                data["solid"] = {"points": _encode("d", _flatten(solid.vertices)), "triangles": _encode("I", _flatten(solid.faces))}  # type: ignore[assignment]
            self.data.append(data)
        return self._numbers[key]

    def place(self, shape: Any, solid: Any, pose: Any) -> dict[str, Any]:
        return {"shape": self.add(shape, solid), **({"solid": True} if solid is not None else {}), "pose": _make_pose(pose)}

    def place_body(self, body: Any, pose: Any) -> list[dict[str, Any]]:
        """A body as shapes and solids at poses; of a compound its parts."""
        if isinstance(body, _ovoid.Compound):
            return [self.place(part, None, pose @ place) for part, place in zip(body.shapes, body.poses)]
        return [self.place(None, body, pose) if isinstance(body, _ovoid.Solid) else self.place(body, None, pose)]


# ---- bodies

def _make_body(shapes: _Shapes, name: str, body: Any, pose: Any) -> dict[str, Any]:
    solid = isinstance(body, _ovoid.Solid)
    parts = shapes.place_body(body, _ovoid.Pose())
    for part in parts:
        part.pop("solid", None)
        if part["pose"] == _make_pose(_ovoid.Pose()):
            del part["pose"]
    return {"name": name, "pose": _make_pose(pose), "parts": parts, **({"solid": True} if solid else {})}


def _make_pair(a: int, b: int, answer: Any) -> dict[str, Any]:
    written = json.loads(_ovoid._write_answer(answer))
    return {"a": a, "b": b, "answer": {key: value for key, value in written.items() if key not in ("a", "b")}}


# ---- robots

def _name_variable(variable: Any) -> str:
    """As the tool: "floor x" of the joint floor."""
    name: str = variable.name
    return name if name == variable.joint else f"{variable.joint} {variable.name[len(variable.joint) + 1:]}"


def _make_joint(joint: Any) -> dict[str, Any]:
    data = {"name": joint.name, "type": joint.type, "parent": joint.parent, "child": joint.child, "origin": _make_pose(joint.origin)}
    if joint.type not in ("fixed", "floating"):
        data["axis"] = joint.axis
    if joint.type in ("revolute", "prismatic"):
        data |= {"lower": joint.lower, "upper": joint.upper}
    if joint.velocity > 0:
        data["velocity"] = joint.velocity
    if joint.mimic is not None:
        data["mimic"] = {"joint": joint.mimic, "multiplier": joint.multiplier, "offset": joint.offset}
    return data


class _Model:
    """A cell as data."""

    def __init__(self, cell: Any, shapes: _Shapes) -> None:
        self.cell, self.robot, self.shapes = cell, cell.robot, shapes
        self.links, self.elements = self.robot.links, self.robot.elements

    def make_side(self, side: Any) -> dict[str, Any]:
        """A side as results name it."""
        if side.link is None:
            alike = [key for key, kept in self.cell._kept.items() if kept[2] is None and kept[1] == self.cell.names[side.body]]
            return {"obstacle": self.cell.names[side.body], "part": alike.index(side.body) + side.part}
        own = [i for i, element in enumerate(self.elements) if element.link == self.links[side.link]]
        held = [key for key, kept in self.cell._kept.items() if kept[2] == side.link]
        data = {"link": self.links[side.link], "element": len(own) + held.index(side.body) if side.body else own.index(side.element)}
        name = self.cell.names[side.body] if side.body else self.elements[side.element].name
        return data if name is None else {**data, "name": name}

    def make_obstacles(self, is_held: bool) -> list[dict[str, Any]]:
        made = []
        for key, (body, name, link, pose) in self.cell._kept.items():
            touching = [one for one in self.links if self.cell.is_body_allowed(key, one)]
            for place in self.shapes.place_body(body, pose) if (link is not None) == is_held else ():
                made.append({"name": name, **({"link": self.links[link]} if is_held else {}), **place, "touching": touching})
        return made

    def make_tree(self, limit_slack: float) -> dict[str, Any]:
        elements = [{"link": one.link, **({} if one.name is None else {"name": one.name}), **self.shapes.place(one.shape, one.solid, one.pose)}
                    for one in self.elements]
        full = [one for one in self.links if any(element.link == one for element in self.elements)]
        disabled = [[a, b] for i, a in enumerate(full) for b in full[i + 1:] if self.cell.is_allowed(a, b)]
        paddings = [[one, self.cell.get_padding(one)] for one in self.links if self.cell.get_padding(one) > 0]
        return {"links": self.links, "joints": [_make_joint(joint) for joint in self.robot.joints],
                "variables": [_name_variable(variable) for variable in self.robot.variables], "elements": elements,
                "held": self.make_obstacles(True), "obstacles": self.make_obstacles(False), "paddings": paddings,
                "limit_slack": limit_slack, "disabled": disabled}

    def make_found(self, answer: Any) -> dict[str, Any]:
        """What an answer to a state says beside its status."""
        if answer.status == "refused":
            return {"code": _name_code(answer.code), "variable": _name_variable(self.robot.variables[answer.variable])}
        if answer.a is None:
            return {} if answer.code is None else {"code": _name_code(answer.code)}
        return {"a": self.make_side(answer.a), "b": self.make_side(answer.b), "lower": answer.lower, "upper": answer.upper}


def _name_code(code: Any) -> str:
    names: list[str] = _ovoid._get_names()["Code"]
    return names[int(code)]


# ---- paths

_STEP_KINDS = ("", "outer", "middle", "ends", "solid")


def _make_edge(model: _Model, path: Any) -> dict[str, Any]:
    count, steps = len(path.states), len(path.steps)
    data = {"status": str(path.status), "states": count, "margin": path.margin}
    if path.status == "refused":
        data["refused"] = _find_refused(model.robot, path)
        data |= model.make_found(path.hit)
    else:
        data["free_until"] = path.free_until
    if path.status == "hit":
        data["hit_at"] = path.hit_at
    if path.status in ("hit", "undecided") and path.hit is not None and path.hit.a is not None and math.isfinite(path.hit.upper):
        segment = int(path.free_until) if path.free_until > 0 else 0
        data["segment"] = min(segment, count - 2) if count > 1 else segment
        data |= model.make_found(path.hit)
    return {**data, "looked_at": path.looked_at, "steps": steps}


def _find_refused(robot: Any, path: Any) -> int:
    """Of a refused segment the end that is the reason."""
    variable, states = robot.variables[path.hit.variable], path.states.tolist()
    i: int = path.refused

    def is_out(state: int) -> bool:
        return not variable.lower <= states[state][path.hit.variable] <= variable.upper
    return i + 1 if not is_out(i) and i + 1 < len(states) and is_out(i + 1) else i


def _make_samples(model: _Model, path: Any) -> list[list[Any]]:
    """The nearest pair at samples of the path, by one checker, in their order."""
    segments = len(path.states) - 1
    most = (_SAMPLES - 1) // _SEGMENT
    count = 1 + (segments * _SEGMENT if segments < most else _SAMPLES - 1)
    places = [segments * i / (count - 1) if count > 1 else 0 for i in range(count)]
    model.cell.reset()
    made = []
    for s in places:
        nears = model.cell.nearest(compute_path_state(path, s), limit_slack=math.inf)[0]
        for row in get_records(nears):
            a, b = (model.make_side(_Side(row, side)) for side in "ab")
            made.append([s, row["lower"], row["upper"], a, b])
    return made


class _Side:
    """A side of a record, as Side has it."""

    def __init__(self, row: dict[str, Any], side: str) -> None:
        self.link, self.element = (None if row[f"{key}_{side}"] == _NO_INDEX else row[f"{key}_{side}"] for key in ("link", "element"))
        self.body, self.part = row[f"body_{side}"], row[f"part_{side}"]


def _make_path(model: _Model, path: Any) -> dict[str, Any]:
    data: dict[str, Any] = {"edges": [_make_edge(model, path)]}
    if path.status == "refused":
        return data
    count = model.cell.pair_count
    data["steps"] = [[row["begin"], row["end"], _STEP_KINDS[row["kind"]], [row["pair"] + i for i in range(8) if row["mask"] >> i & 1]]
                     for row in get_records(path.steps)]
    data["pairs"] = [[model.make_side(side) for side in model.cell.pair(i)] for i in range(count)] if count <= _PAIRS else []
    data["clearance"] = _make_samples(model, path)
    return data


def _make_robot(scene: Scene, shapes: _Shapes, margin: float, limit_slack: float) -> dict[str, Any]:
    cell, is_path = get_cell(scene.model), hasattr(scene.model, "hit_at")
    model = _Model(cell, shapes)
    data: dict[str, Any] = {**model.make_tree(limit_slack), "states": scene.states, "answers": []}
    if is_path:
        return {**data, "path": _make_path(model, scene.model)}
    for i, (name, q) in enumerate(zip(scene.names, scene.states)):
        answer = cell.collide(q, margin=margin, limit_slack=limit_slack)
        named = {} if name is None else {"name": name}
        data["answers"].append({"state": i, **named, "status": str(answer.status), **model.make_found(answer)})
    return data


# ---- the page

def make_data(items: tuple[Any, ...], title: str, unit: str | None, margin: float | None, limit_slack: float) -> dict[str, Any]:
    """The data of a page."""
    scene, shapes = make_scene(items), _Shapes()
    data: dict[str, Any] = {"format": 1, "version": _ovoid.__version__, "title": title, "command": "", "unit": unit, "margin": margin, "shapes": shapes.data}
    if scene.model is not None:
        is_path = hasattr(scene.model, "hit_at")
        reach: float = scene.model.margin if is_path else margin or 0
        robot = _make_robot(scene, shapes, reach, scene.model.limit_slack if is_path else limit_slack)
        return {**data, "margin": reach if reach > 0 else None, "bodies": [], "pairs": [], "robot": robot}
    bodies = [_make_body(shapes, one.name or "body", one.body, one.pose) for one in scene.bodies]
    return {**data, "bodies": bodies, "pairs": [_make_pair(a, b, answer) for a, b, answer in scene.links]}


def show(*items: Any, path: PathLike | None = None, title: str = "ovoid", unit: str | None = None, margin: float | None = None,
         limit_slack: float = 1e-6, browser: bool = True) -> str:
    """Writes a page of what draw() draws, and opens the browser with it: its path.

    The page turns and zooms, lists the pairs and checks their proofs itself. (cell, states) shows states with their verdicts, a RobotPath
    the path and the steps of its proof. path: where the page is written, None: a new file in the temporary folder. margin, limit_slack: of
    the states. browser=False: the page is only written. The page is made of a template; where there is none, Error says how to build it."""
    before, behind = _read_template()
    data = make_data(items, title, unit, margin, limit_slack)
    text = json.dumps(_clean(data), separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    if path is None:
        handle, name = tempfile.mkstemp(suffix=".html", prefix="ovoid-")
        os.close(handle)
    else:
        name = os.fsdecode(path)
    with open(name, "w", encoding="utf-8") as file:
        file.write(f'{before}<script id="ovoid-data" type="application/json">{text}</script>{behind}')
    if browser:
        webbrowser.open(pathlib.Path(name).resolve().as_uri())
    return name


def show_one(self: Any, path: PathLike | None = None, **how: Any) -> str:
    """ovoid.show of this alone: writes its page, opens the browser with it, and returns the page's path."""
    return show(self, path=path, **how)
