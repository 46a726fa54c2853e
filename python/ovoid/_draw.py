"""draw(): a picture of bodies, answers, worlds and robots as SVG, by the library; and what a notebook shows of them."""

from __future__ import annotations

import html
import math
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from . import _ovoid
from ._enums import Code, Error
from ._scene import Scene, add_model, make_scene

if TYPE_CHECKING:
    from ._types import PathLike, Vec3

#: The bits of ovoid_picture_layer.
_LAYERS = {"outer": 1, "inner": 2, "areas": 4, "witness": 8, "names": 16, "legend": 32, "meshes": 64}
#: Names' ends of other formats, which the tool refuses for a picture too.
_OTHERS = frozenset("stl obj off ply dae gltf glb 3ds x3d fbx 3mf json csv ovoid ovoids png jsonl pdf jpg html".split())
#: Most bodies of which a notebook draws a picture without being asked.
_MOST = 400


class Picture:
    """A picture, which notebooks show. svg: its text."""

    def __init__(self, svg: str) -> None:
        self.svg = svg

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"<ovoid.Picture: SVG, {len(self.svg)} characters>"

    def write(self, path: PathLike) -> None:
        """Writes the picture to a file. A name of another format, as picture.png, is refused."""
        name = os.fsdecode(path)
        if os.path.splitext(name)[1][1:].lower() in _OTHERS:
            raise Error(f"{name}: the picture is svg; choose a name that says so", Code.ARGUMENT)
        with open(name, "w", encoding="utf-8") as file:
            file.write(self.svg)


def _read_layers(layers: Iterable[str] | None) -> int:
    bits = 0
    for layer in layers or ():
        if layer not in _LAYERS:
            raise Error(f"there is no layer {layer!r}: {', '.join(_LAYERS)}", Code.ARGUMENT)
        bits |= _LAYERS[layer]
    return bits


def _list_parts(scene: Scene) -> tuple[tuple[Any, ...], list[int]]:
    """The shapes and solids of all bodies, and of each body the number of its first."""
    parts: list[tuple[Any, ...]] = []
    firsts = []
    for i, (name, body, pose, group) in enumerate(scene.bodies):
        firsts.append(len(parts))
        if isinstance(body, _ovoid.Compound):
            for k, (shape, place) in enumerate(zip(body.shapes, body.poses)):
                parts.append((shape, None, pose @ place, None if k else name, group or i + 1))
        elif isinstance(body, _ovoid.Solid):
            parts.append((_ovoid.Shape.from_points(body.vertices), body, pose, name, group or i + 1))
        else:
            parts.append((body, None, pose, name, group or i + 1))
    return tuple(parts), firsts


def _list_links(scene: Scene, firsts: list[int]) -> tuple[tuple[int, int, Any], ...]:
    """The links, between the parts of compounds that decide."""
    def get_part(body: Any, part: int) -> int:
        return part if isinstance(body, _ovoid.Compound) else 0
    return tuple((firsts[a] + get_part(answer.a, answer.part_a), firsts[b] + get_part(answer.b, answer.part_b), answer)
                 for a, b, answer in scene.links)


def draw(*items: Any, title: str | None = None, unit: str | None = None, width: int = 0, height: int = 0, view: Vec3 = (0, 0, 0),
         layers: Iterable[str] | None = None) -> Picture:
    """A Picture of bodies, (body, pose) tuples, answers, worlds, robots and cells, or lists or dicts by names of these.

    Answers are drawn with their closest points; of at most 12 bodies without an answer the nearest of each is found. A robot is drawn
    at its default state, (cell, q) at another, a RobotPath where it hits or begins. width, height: pixels, 0: 1200 and 800. view: from
    the scene to the eye. layers: of "outer", "inner", "areas", "witness", "names", "legend", "meshes"; None: as few bodies or many need."""
    scene = make_scene(items)
    if scene.model is not None:
        add_model(scene, scene.model)
        layers = layers or ("witness", "names", "legend", "meshes")  # ellipsoids would bury a robot
    parts, firsts = _list_parts(scene)
    x, y, z = view
    if not (0 <= width < 2**31 and 0 <= height < 2**31 and all(map(math.isfinite, view))):
        raise Error(f"width, height: pixels are wanted, view: a direction, not {width}, {height}, {view}", Code.ARGUMENT)
    return Picture(_ovoid._draw(parts, _list_links(scene, firsts), title, unit, width, height, (x, y, z), _read_layers(layers)))


# ---- in notebooks

def _count_bodies(item: Any) -> int:
    if hasattr(item, "cell") or hasattr(item, "robot"):
        cell = getattr(item, "cell", item)
        return len(cell.robot.elements) + len(cell.bodies)
    return len(getattr(item, "elements", ())) or len(getattr(item, "shapes", ())) or (len(item) if isinstance(item, _ovoid.World) else 1)


def _repr_svg_(self: Any) -> str | None:
    """The picture of a notebook; None, and the text is shown, where there is nothing to draw or too much."""
    if not 1 <= _count_bodies(self) <= _MOST:
        return None
    try:
        return draw(self, width=900, height=600).svg
    except Error:
        return None


def _repr_html_(self: Any) -> str | None:
    """The picture with the text of repr() below it."""
    svg = _repr_svg_(self)
    return svg and f'<figure style="margin:0">{svg}<figcaption><code>{html.escape(repr(self))}</code></figcaption></figure>'
