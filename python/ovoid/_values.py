"""Results that are plain tuples with names."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, NoReturn

if TYPE_CHECKING:
    from . import Agreement, Answer, Code, Limit, Pose, RobotStatus, Shape, Solid, Stage, Status, Touch
    from ._types import Floats, Indices, PoseLike, Records, Vec3


class Contacts(NamedTuple):
    """The pairs of a world that are not proven farther than the margin, sorted by a, then b.

    items: an array of records a, b (ids), part_a, part_b, status, stage, limit, iterations, lower, upper. witnesses: beside
    them point_a, point_b, normal of distances and depths, else None. The rest counts what the step did (docs/world.md)."""

    items: Records
    witnesses: Records | None
    bodies: int
    pairs: int
    aged: int
    queried: int
    added: int
    dropped: int
    moved: int
    rebuilt: bool
    memory: int


class ManifoldPolygon(NamedTuple):
    """The whole polygon of a contact, counter-clockwise seen from the tip of the normal: 1 corner is a point, 2 are a segment.

    points: an array of records point_a, point_b, separation, id. grown: as Manifold.grown. inner: the area that is in contact
    for certain; outer: that of a polygon that holds every point of contact."""

    points: Records
    grown: float
    inner: float
    outer: float


class Material(NamedTuple):
    """What a body of a World brings to its contacts: a margin of its own, friction and restitution."""

    margin: float
    friction: float
    restitution: float


class WorldManifolds(NamedTuple):
    """The contacts of a step of a World, pairs sorted by a, then b.

    items: an array of records a, b (ids), user_a, user_b, status, stage, limit, iterations, lower, upper, margin, friction,
    restitution, first, count (its manifolds in parts), event (0: begins, 1: stays). parts: an array of records part_a, part_b and
    the fields of a Manifold. points, (n, 4), beside the parts: point_a, point_b, separation, id; as many as the part's count.
    grown: beside the parts, as Manifold.grown. ended: pairs of the call before that are none any more, records a, b, user_a,
    user_b. begun: how many items begin. kept: how many parts were taken over, as neither body moved."""

    items: Records
    parts: Records
    points: Records
    grown: Floats
    ended: Records
    begun: int
    kept: int


class Hit(NamedTuple):
    """A pair that a query of a world found: ids, or a: 0 of a probe, its number of several; the Answer.

    lower: of nearest ones, no pair is nearer. The answer of compounds has no proof for the other parts: verify() wants that of
    distance(..., earlier=answer)."""

    a: int
    b: int
    lower: float
    answer: Answer


class Cast(NamedTuple):
    """The first hit of a ray or of a moved body: the id, lower <= t <= upper, the body's point and its normal."""

    body: int
    part: int
    probe: int
    lower: float
    upper: float
    point: Vec3
    normal: Vec3
    undecided: int


class Joint(NamedTuple):
    """A joint: child frame = parent frame, then origin, then what the joint does along or about its axis. URDF's words.

    type: fixed, revolute, continuous, prismatic, planar or floating. parent, child: links' names. lower, upper: of revolute and
    prismatic ones, radians or lengths. velocity: most, a second; 0: not given. mimic: the joint it follows, as multiplier * q +
    offset, or None."""

    name: str
    type: str
    parent: str
    child: str
    origin: PoseLike = None
    axis: Vec3 = (1, 0, 0)
    lower: float = 0
    upper: float = 0
    velocity: float = 0
    mimic: str | None = None
    multiplier: float = 1
    offset: float = 0


class Variable(NamedTuple):
    """One number of a state: its name ("elbow", "base/x"), its joint, which of its numbers, and the limits."""

    name: str
    joint: str
    component: int
    lower: float
    upper: float
    velocity: float


class Element(NamedTuple):
    """A part of a link's collision geometry; pose in the link's frame. solid: counts in the place of the shape, which is its
    hull, or None."""

    link: str
    shape: Shape
    pose: PoseLike = None
    name: str | None = None
    solid: Solid | None = None


class Side(NamedTuple):
    """One side of a pair: the link's index (None: an obstacle), the element's (None: a body), the body's id (0: an
    element) and its part; name: of the link or the obstacle, as "hand", "hand[palm]" of links with several elements, "table"."""

    link: int | None
    element: int | None
    body: int
    part: int
    name: str


def _refuse_bool(self: object) -> NoReturn:
    raise TypeError(f"an answer is neither true nor false (ovoid.{type(self).__name__}): compare its status, for example "
                    'answer.status == "free"')


class StateAnswer(NamedTuple):
    """What is proven of a state: a RobotStatus; of HIT and UNDECIDED the Sides of the pair and the bracket of its
    signed distance; of REFUSED the Code and the variable; Code.EMPTY of UNDECIDED where no pair is queried."""

    status: RobotStatus
    a: Side | None
    b: Side | None
    lower: float
    upper: float
    code: Code | None
    variable: int | None

    def __bool__(self) -> NoReturn:
        _refuse_bool(self)


class SweptAnswer(NamedTuple):
    """What is known of two SweptSpheres, without a proof: lower <= d <= upper, where d is the signed distance, rounding included.

    point_a, point_b, normal: as of an Answer, world frame; None where they were not asked for or nothing is decided."""

    status: Status
    lower: float
    upper: float
    stage: Stage
    limit: Limit
    iterations: int
    point_a: Vec3 | None
    point_b: Vec3 | None
    normal: Vec3 | None

    def __bool__(self) -> NoReturn:
        _refuse_bool(self)


class MatrixPair(NamedTuple):
    """What is known of two links: a Touch, how many samples were hits and free, a state of each or None; why the pair may be
    left out ("Adjacent", "Never", "Always") by what is proven, and by what was sampled too, or None."""

    a: str
    b: str
    touch: Touch
    is_neighbour: bool
    samples: int
    hits: int
    frees: int
    cells: int
    hit: Floats | None
    free: Floats | None
    reason: str | None
    sampled_reason: str | None


class SphereAudit(NamedTuple):
    """Spheres against a link: brackets (lower, upper) of the deepest uncovered point's depth (upper <= 0: all is covered),
    of the uncovered volume, of the spheres' volume outside the link, of the link's and of the spheres' volume. point: shows
    depth's lower end, of that element, nearest to that sphere."""

    depth: tuple[float, float]
    point: Vec3
    element: int
    sphere: int
    uncovered: tuple[float, float]
    excess: tuple[float, float]
    link: tuple[float, float]
    spheres: tuple[float, float]
    cells: int


class PartsAudit(NamedTuple):
    """Convex parts against a solid: brackets (lower, upper) of two lengths. uncovered: the greatest distance of a point of the
    solid from its nearest part; enlarge_parts by its upper end covers. excess: the greatest distance of a point of a part from
    the solid, excess_of_parts no less than each part's own. The points show the lower ends; uncovered_part is one of the nearest,
    excess_part has the point. cells: looked at."""

    uncovered: tuple[float, float]
    excess: tuple[float, float]
    uncovered_point: Vec3
    uncovered_part: int
    excess_point: Vec3
    excess_part: int
    excess_of_parts: Floats
    cells: int


class Obstacle(NamedTuple):
    """An obstacle of a scene: a solid counts in the place of the shape; the link that holds it, or None."""

    name: str
    shape: Shape
    pose: Pose
    solid: Solid | None
    frame: str | None
    link: str | None


class MotionRequest(NamedTuple):
    """A planning request: the group's name, and joints' numbers by their names at the start and at each goal."""

    group: str
    start: dict[str, float]
    goals: list[dict[str, float]]


class Trajectory(NamedTuple):
    """A trajectory of MoveIt or ROS: joints' numbers by their names at trajectory_start ({} where there is none) and at each
    point. A joint that a point does not name is where the point before, or else trajectory_start, has it. times: of the points in
    seconds, None where they have none."""

    start: dict[str, float]
    points: list[dict[str, float]]
    times: list[float] | None


class Clearance(NamedTuple):
    """The smallest clearance of a path: lower <= the least signed distance <= upper, proven. at: where a pair, of Sides a and b,
    is no farther apart than upper, or None. status: a RobotStatus against the margin; of REFUSED which state, Code and variable;
    Code.EMPTY of UNDECIDED where no pair is queried. looked_at: states."""

    status: RobotStatus
    lower: float
    upper: float
    at: float | None
    a: Side | None
    b: Side | None
    refused: int | None
    code: Code | None
    variable: int | None
    looked_at: int

    def __bool__(self) -> NoReturn:
        _refuse_bool(self)


class Comparison(NamedTuple):
    """States of a robot beside a model: counts by Agreement, the Agreement of each state (an array, by number), and of the missed
    states that where the robot overlaps most, with its pair, a record as of Cell.near; None where none is missed."""

    counts: dict[Agreement, int]
    agreements: Indices
    deepest_state: int | None
    deepest: Records | None
