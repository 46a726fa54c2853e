"""Results that are plain tuples with names."""

from collections import namedtuple

Contacts = namedtuple("Contacts", "items witnesses bodies pairs aged queried added dropped moved rebuilt memory")
Contacts.__doc__ = """The pairs of a world that are not proven farther than the margin, sorted by a, then b.

items: an array of records a, b (ids), part_a, part_b, status, stage, limit, iterations, lower, upper. witnesses: beside
them point_a, point_b, normal of distances and depths, else None. The rest counts what the step did (docs/world.md)."""

Hit = namedtuple("Hit", "a b lower answer")
Hit.__doc__ = """A pair that a query of a world found: ids, or a: 0 of a probe, its number of several; the Answer.

lower: of nearest ones, no pair is nearer. The answer of compounds has no proof for the other parts: verify() wants that of
distance(..., earlier=answer)."""

Cast = namedtuple("Cast", "body part probe lower upper point normal undecided")
Cast.__doc__ = """The first hit of a ray or of a moved body: the id, lower <= t <= upper, the body's point and its normal."""

Joint = namedtuple("Joint", "name type parent child origin axis lower upper velocity mimic multiplier offset",
                   defaults=(None, (1, 0, 0), 0, 0, 0, None, 1, 0))
Joint.__doc__ = """A joint: child frame = parent frame, then origin, then what the joint does along or about its axis. URDF's words.

type: fixed, revolute, continuous, prismatic, planar or floating. parent, child: links' names. lower, upper: of revolute and
prismatic ones, radians or lengths. velocity: most, a second; 0: not given. mimic: the joint it follows, as multiplier * q +
offset, or None."""

Variable = namedtuple("Variable", "name joint component lower upper velocity")
Variable.__doc__ = """One number of a state: its name ("elbow", "base/x"), its joint, which of its numbers, and the limits."""

Element = namedtuple("Element", "link shape pose name", defaults=(None, None))
Element.__doc__ = """A convex part of a link's collision geometry; pose in the link's frame."""

Side = namedtuple("Side", "link element body part")
Side.__doc__ = """One side of a pair: the link's index (None: an obstacle), the element's (None: a body), the body's id (0: an
element) and its part."""

StateAnswer = namedtuple("StateAnswer", "status a b lower upper code variable")
StateAnswer.__doc__ = """What is proven of a state: a RobotStatus; of HIT and UNDECIDED the Sides of the pair and the bracket of its
signed distance; of REFUSED the Code and the variable."""

MatrixPair = namedtuple("MatrixPair", "a b touch is_neighbour samples hits frees cells hit free reason sampled_reason")
MatrixPair.__doc__ = """What is known of two links: a Touch, how many samples were hits and free, a state of each or None; why the pair may be
left out ("Adjacent", "Never", "Always") by what is proven, and by what was sampled too, or None."""

SphereAudit = namedtuple("SphereAudit", "depth point element sphere uncovered excess link spheres cells")
SphereAudit.__doc__ = """Spheres against a link: brackets (lower, upper) of the deepest uncovered point's depth (upper <= 0: all is covered),
of the uncovered volume, of the spheres' volume outside the link, of the link's and of the spheres' volume. point: shows
depth's lower end, of that element, nearest to that sphere."""

PartsAudit = namedtuple("PartsAudit", "uncovered excess uncovered_point uncovered_part excess_point excess_part excess_of_parts cells")
PartsAudit.__doc__ = """Convex parts against a solid: brackets (lower, upper) of two lengths. uncovered: the greatest distance of a point of the
solid from its nearest part; enlarge_parts by its upper end covers. excess: the greatest distance of a point of a part from
the solid, excess_of_parts no less than each part's own. The points show the lower ends; uncovered_part is one of the nearest,
excess_part has the point. cells: looked at."""


def _refuse_bool(self):
    raise TypeError(f"an answer is neither true nor false (ovoid.{type(self).__name__}): compare its status, for example "
                    'answer.status == "free"')


Obstacle = namedtuple("Obstacle", "name shape pose solid frame link")
Obstacle.__doc__ = """An obstacle of a scene: a solid counts in the place of the shape; the link that holds it, or None."""

MotionRequest = namedtuple("MotionRequest", "group start goals")
MotionRequest.__doc__ = """A planning request: the group's name, and joints' numbers by their names at the start and at each goal."""

Clearance = namedtuple("Clearance", "status lower upper at a b refused code variable looked_at")
Clearance.__doc__ = """The smallest clearance of a path: lower <= the least signed distance <= upper, proven. at: where a pair, of Sides a and b,
is no farther apart than upper, or None. status: a RobotStatus against the margin; of REFUSED which state, Code and variable.
looked_at: states."""

Comparison = namedtuple("Comparison", "counts agreements deepest_state deepest")
Comparison.__doc__ = """States of a robot beside a model: counts by Agreement, the Agreement of each state (an array, by number), and of the missed
states that where the robot overlaps most, with its pair, a record as of Cell.near; None where none is missed."""

StateAnswer.__bool__ = Clearance.__bool__ = _refuse_bool
