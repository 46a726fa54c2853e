"""What the C classes have that is written in Python: reprs, pictures in notebooks, states of robots by names."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from . import _ovoid
from ._draw import _repr_html_, _repr_svg_
from ._enums import Code, Error
from ._page import show_one
from ._planning import plan


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun[:-1]}ies" if noun == "body" else f"{number} {noun}s"


def _write_impact(impact: Any) -> str:
    if impact.status == "free":
        return f"free from {impact.begin!r} to {impact.end!r}"
    return f"{impact.status}, {impact.free_until!r} <= t <= {impact.hit_at!r}"


#: What the repr of a class says behind its name.
_WORDS: dict[str, Callable[[Any], str]] = {
    "Approach": lambda it: f"{it.status}, {it.lower!r} <= least d <= {it.upper!r}, at t = {it.time!r}",
    "Bodies": lambda it: _count(len(it), "body"),
    "Cell": lambda it: f"{it.robot.name!r}, {_count(len(it.bodies), 'body')}, {_count(it.pair_count, 'pair')}",
    "Compound": lambda it: _count(len(it.shapes), "part"),
    "Ellipsoid": lambda it: f"radii {it.radii!r}",
    "Gradient": lambda it: "of a distance by the motions of both bodies",
    "Impact": _write_impact,
    "Motion": lambda it: f"begins at {it.pose(-1e300).xyz!r}, ends at {it.pose(1e300).xyz!r}",
    "Prepared": lambda it: f"{it.shape!r} at {it.pose.xyz!r}",
    "RayHit": lambda it: f"{it.status}, {it.lower!r} <= t <= {it.upper!r}",
    "Smooth": lambda it: f"outer {it.outer.value!r}, inner {it.inner.value!r}",
    "SmoothValue": lambda it: f"{it.value!r}, error {it.error!r}",
    "SweptSphere": lambda it: f"{it.kind} at {it.pose.xyz!r}",
    "World": lambda it: _count(len(it), "body"),
}


def _make_repr(name: str, words: Callable[[Any], str]) -> Callable[[Any], str]:
    def write(self: Any) -> str:
        return f"<ovoid.{name}: {words(self)}>"
    return write


def _find_variable(robot: Any, name: str) -> int:
    names = [variable.name for variable in robot.variables]
    if name not in names:
        raise Error(f"the robot has no variable {name!r}: {', '.join(names)}", Code.INDEX)
    return names.index(name)


def q(self: Any, state: str | Mapping[str, float] | None = None, /, **values: float) -> Any:
    """The numbers of a state, a list that each call of a state takes: those of a named state of the SRDF, or of a dict by variables' names, and
    of the others those of default_state(); then the values given by name, as q("ready", panda_joint1=0.3)."""
    numbers = self.default_state()
    given = dict(self.named_state(state) if isinstance(state, str) else state or {}, **values)
    for name, value in given.items():
        numbers[_find_variable(self, name)] = value
    return numbers


def default_state(self: Any) -> Any:
    """The state that MoveIt and the tool take by default, a list: zeros, the middle of the limits where 0 is outside them, and of a
    floating joint the quaternion that turns nothing."""
    numbers: list[float] = self.lower.tolist()
    for i, variable in enumerate(self.variables):
        turned = 1.0 if variable.name.endswith("/qw") and variable.component == 3 else 0.0
        middle = variable.lower + (variable.upper - variable.lower) / 2
        numbers[i] = middle if math.isfinite(middle) and not variable.lower <= turned <= variable.upper else min(max(turned, variable.lower), variable.upper)
    return numbers


def named_state(self: Any, name: str, /) -> dict[str, float]:
    """The numbers of a named state of the SRDF by the variables' names; where several groups have the name, those of all."""
    found = [values for known, _group, values in self.states if known == name]
    if not found:
        raise Error(f"the robot has no state {name!r}: {', '.join(sorted({known for known, _, _ in self.states})) or 'it has none'}", Code.INDEX)
    joints = {joint: numbers for values in found for joint, numbers in values.items()}
    return {variable.name: joints[variable.joint][variable.component] for variable in self.variables if variable.joint in joints}


def q_dict(self: Any, q: Any, /) -> dict[str, float]:
    """The numbers of a state (variables,) by the variables' names."""
    numbers, names = q.tolist() if hasattr(q, "tolist") else list(q), [variable.name for variable in self.variables]
    if len(numbers) != len(names):
        raise Error(f"a state of this robot has {len(names)} numbers, not {len(numbers)}", Code.ARGUMENT)
    return dict(zip(names, map(float, numbers)))


for _name, _words in _WORDS.items():
    if hasattr(_ovoid, _name):
        setattr(getattr(_ovoid, _name), "__repr__", _make_repr(_name, _words))
for _name in ("Answer", "Approach", "Bodies", "Cell", "Compound", "Impact", "Prepared", "Robot", "RobotPath", "Shape", "Solid", "World"):
    if hasattr(_ovoid, _name):
        setattr(getattr(_ovoid, _name), "show", show_one)
        setattr(getattr(_ovoid, _name), "_repr_svg_", _repr_svg_)
        setattr(getattr(_ovoid, _name), "_repr_html_", _repr_html_)
if hasattr(_ovoid, "Robot"):
    for _method in (q, default_state, named_state, q_dict):
        setattr(_ovoid.Robot, _method.__name__, _method)
if hasattr(_ovoid, "Cell"):
    setattr(_ovoid.Cell, "plan", plan)
