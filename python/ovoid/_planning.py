"""Cell.plan: from a start to a goal, by planners of OMPL whose motions are proven; the path is proven once more as a whole."""

from __future__ import annotations

import math
import threading
import warnings
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from . import _ovoid
from ._enums import Code, Error
from ._scene import list_states

if TYPE_CHECKING:
    from . import RobotPath
    from ._types import Floats, StateLike, StatesLike

_PLANNERS = ("rrtconnect", "biest")
#: OMPL has one seed a process.
_ONE_AT_A_TIME = threading.Lock()


class Plan(NamedTuple):
    """A path that was found: its states, linear in between, and its proof, a RobotPath that verify() has checked. seed, planner: as they were
    given. length, raw_length: in radians and lengths together, as found and before it was shortened. planned, shortened: seconds. motions:
    how many were proven or not."""

    states: Floats
    path: RobotPath
    seed: int
    planner: str
    length: float
    raw_length: float
    planned: float
    shortened: float
    motions: int


def _get_search() -> Any:
    try:
        from . import _ompl  # type: ignore[attr-defined]  # not in every build
    except ImportError as trouble:
        raise Error("this build of ovoid has no planners: OMPL was not there when it was built (Debian: libompl-dev and libeigen3-dev; then "
                    f"build again) ({trouble})", Code.FILE) from trouble
    return _ompl.search


# ---- which variables move

def _find_movable(robot: Any) -> list[int]:
    """All that have limits, and continuous joints."""
    types = {joint.name: joint.type for joint in robot.joints}
    return [i for i, one in enumerate(robot.variables)
            if types[one.joint] == "continuous" or (types[one.joint] != "floating" and math.isfinite(one.lower) and math.isfinite(one.upper) and one.lower < one.upper)]


def _find_moving(robot: Any, moving: str | Sequence[str] | None) -> list[int]:
    """The variables of a group of the SRDF, of joints by their names, or of all that can move."""
    if moving is None or moving == "":
        return _find_movable(robot)
    groups = {name: joints for name, joints, _links in robot.groups}
    if isinstance(moving, str) and moving not in groups:
        raise Error(f"the robot has no group {moving!r}: {', '.join(sorted(groups)) or 'it has none'}", Code.INDEX)
    names = groups[moving] if isinstance(moving, str) else list(moving)
    if not names:
        raise Error(f"moving={moving!r} has no joint; None moves all that can move", Code.EMPTY)
    for name in names:
        robot.find_joint(name)
    return [i for i, one in enumerate(robot.variables) if one.joint in names]


# ---- the ends

def _refuse_type(what: str, state: Any) -> TypeError:
    return TypeError(f"{what}: a state is numbers, one for each variable of the robot, a name or a dict by names, not {state!r}")


def _read_numbers(robot: Any, state: Any, what: str) -> list[float]:
    try:
        if isinstance(state, (bytes, bytearray)):
            raise TypeError
        numbers = [float(number) for number in (state.tolist() if hasattr(state, "tolist") else state)]
    except (TypeError, ValueError):
        raise _refuse_type(what, state) from None
    if len(numbers) != len(robot.variables):
        raise Error(f"{what} has {len(numbers)} number{'' if len(numbers) == 1 else 's'}, the robot {len(robot.variables)} variables", Code.ARGUMENT)
    return numbers


def _fill_state(robot: Any, state: Any, others: list[float], what: str) -> list[float]:
    """A state given by name or by a dict has the numbers of another where it names none."""
    if not isinstance(state, (str, Mapping)):
        return _read_numbers(robot, state, what)
    named = robot.named_state(state) if isinstance(state, str) else state
    numbers: list[float] = robot.q({**robot.q_dict(others), **named})
    return numbers


def _list_goals(robot: Any, goal: Any, begin: list[float]) -> list[list[float]]:
    """The goals; joints that one does not name stay where they begin, and one without joints would be the start."""
    if isinstance(goal, (bytes, bytearray)) or not hasattr(goal, "__iter__"):
        raise _refuse_type("the goal", goal)
    given = list_states(goal)
    goals = []
    for i, one in enumerate(given):
        what = "the goal" if len(given) == 1 else f"goal {i}"
        if isinstance(one, Mapping) and not one:
            raise Error(f"{what} names no joint", Code.EMPTY)
        goals.append(_fill_state(robot, one, begin, what))
    return goals


def _compute_value(robot: Any, joints: dict[str, Any], joint: Any, q: list[float]) -> float:
    """The number of a joint, which may follow another."""
    if joint.mimic is None:
        own: float = q[robot.joint_variable(joint.name)]
        return own
    value: float = joint.multiplier * _compute_value(robot, joints, joints[joint.mimic], q) + joint.offset
    return value


def _explain_refusal(robot: Any, answer: Any, q: list[float]) -> str:
    """Which number is outside of which limits: the variable's, or those of a joint that follows it."""
    variable, joints = robot.variables[answer.variable], {joint.name: joint for joint in robot.joints}
    value = q[answer.variable]
    if not variable.lower <= value <= variable.upper:
        return f"{variable.name}: {value:.9g} is outside its limits, {variable.lower:.9g} .. {variable.upper:.9g}"
    for joint in robot.joints:
        if joint.mimic is None or joint.type not in ("revolute", "prismatic") or robot.joint_variable(joint.name) != answer.variable:
            continue
        value = _compute_value(robot, joints, joint, q)
        if not joint.lower <= value <= joint.upper:
            return f"{variable.name}: {joint.name}, which follows it, is {value:.9g}, outside its limits, {joint.lower:.9g} .. {joint.upper:.9g}"
    return f"{variable.name}: {answer.code}"


def _explain(robot: Any, answer: Any, q: list[float]) -> str:
    if answer.status == "refused":
        return _explain_refusal(robot, answer, q)
    return f"not free: {answer.a.name}, {answer.b.name}: {answer.status}" if answer.a else "no pair of bodies is queried"


def _validate_still(robot: Any, start: list[float], goal: list[float], moving: list[int]) -> None:
    for i, variable in enumerate(robot.variables):
        if start[i] != goal[i] and i not in moving:
            raise Error(f"the goal is {goal[i]!r} in {variable.name}, the start {start[i]!r}, and the planner does not move it: moving=", Code.ARGUMENT)


def _find_goals(cell: Any, start: list[float], goals: list[list[float]], how: dict[str, Any]) -> list[list[float]]:
    """Those that are free; the start has to be."""
    answer = cell.collide(start, **how)
    if answer.status != "free":
        raise Error(f"the start: {_explain(cell.robot, answer, start)}", Code.ARGUMENT)
    free = []
    for i, goal in enumerate(goals):
        answer = cell.collide(goal, **how)
        if answer.status == "free":
            free.append(goal)
        elif len(goals) == 1:
            raise Error(f"the goal: {_explain(cell.robot, answer, goal)}", Code.ARGUMENT)
        else:
            warnings.warn(f"goal {i}: {_explain(cell.robot, answer, goal)}", stacklevel=4)
    if not free:
        raise Error("no goal is free", Code.ARGUMENT)
    return free


# ---- planning

def plan(self: Any, start: StateLike, goal: StatesLike, *, moving: str | Sequence[str] | None = None, planner: Literal["rrtconnect", "biest"] = "rrtconnect",
         seconds: float = 10, seed: int = 1, raw: bool = False, margin: float = 0, limit_slack: float = 0, without_self: bool = False,
         without_obstacles: bool = False) -> Plan | None:
    """A path from a start to a goal, or to one of several, that is proven free at all times: a Plan, or None where none was found in time.

    A planner of OMPL searches, every motion of which is proven; the path is shortened, unless raw, proven as a whole, and that proof verified. States
    are given as everywhere; joints that a goal's name or dict does not name stay where they start. moving: a group of the SRDF, or joints' names; None or "":
    all but floating ones and lengths without limits; others stand still. The same seed gives the same path, however fast the machine is; seconds: give
    up after that. A start or a goal that hits raises Error, of several goals it is a UserWarning. Ctrl-C ends it. It needs a build with OMPL."""
    search, robot = _get_search(), self.robot
    if planner not in _PLANNERS:
        raise Error(f"there is no planner {planner!r}: {', '.join(_PLANNERS)}", Code.ARGUMENT)
    if not 1 <= seed < 2**32 or not 0 < seconds < math.inf:
        raise Error("seed is a whole number from 1 to 2**32 - 1, seconds a number above 0", Code.ARGUMENT)
    how = {"margin": margin, "limit_slack": limit_slack, "without_self": without_self, "without_obstacles": without_obstacles}
    begin = _fill_state(robot, start, robot.default_state(), "the start")
    goals = _list_goals(robot, goal, begin)
    variables = _find_moving(robot, moving)
    if not variables or not goals:
        raise Error("no joint moves" if goals else "there is no goal", Code.EMPTY)
    for one in goals:
        _validate_still(robot, begin, one, variables)
    goals = _find_goals(self, begin, goals, how)
    with _ONE_AT_A_TIME:
        found = self._search(search, begin, goals, variables, margin, limit_slack, without_self, without_obstacles, _PLANNERS.index(planner), seed, seconds, raw)
    states, length, raw_length, planned, shortened, motions = found
    if states is None:
        return None
    path = self.find_hit(states, **how)
    _ovoid.verify(path)
    if path.status != "free":
        raise Error(f"the path as a whole is not proven free: {path.status}", Code.PROOF)
    return Plan(states, path, seed, planner, length, raw_length, planned, shortened, motions)
