"""The enumerations and the exception of ovoid; their numbers are those of the C library."""

import enum


class Named(enum.IntEnum):
    """Numbers as in arrays of results; str() is the library's word, which a member equals. Another text raises ValueError."""

    def __str__(self) -> str:
        return self.name.lower()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, str):
            return int.__eq__(self, other)
        names = [str(member) for member in type(self)]
        if other not in names:
            raise ValueError(f"{type(self).__name__} has no {other!r}: {', '.join(names)}")
        return str(self) == other

    def __ne__(self, other: object) -> bool:
        equal = self == other
        return equal if equal is NotImplemented else not equal

    __hash__ = int.__hash__


class Status(Named):
    """What is proven of the signed distance d."""

    UNDECIDED = 0  #: the sign of d is not proven; limit says why
    SEPARATED = 1  #: lower > 0
    TOUCHING = 2  #: lower <= 0 <= upper, and the bracket is narrower than the tolerance
    OVERLAPPING = 3  #: upper < 0


class Stage(Named):
    """What decided."""

    NONE = 0
    PROOF = 1  #: the earlier proof handed in
    SPHERE = 2  #: bounding spheres
    OUTER = 3  #: outer ellipsoids
    SUPPORT = 4  #: the polyhedra's supports along the ellipsoids' direction
    INNER = 5  #: inner ellipsoids
    GJK = 6  #: exact
    EPA = 7  #: exact
    REFINE = 8  #: in pairs of doubles


class Limit(Named):
    """Why a query stopped before its bracket was narrower than the tolerance."""

    NONE = 0  #: it did not
    ANSWERED = 1  #: the query is answered; the bracket is true but wide
    CAP = 2  #: proven farther than cap
    ITERATIONS = 3  #: iterations used up
    PRECISION = 4  #: no further progress
    CAPACITY = 5  #: the depth search filled its working memory
    POSE_A = 6
    POSE_B = 7
    OPTIONS = 8
    SHAPE_A = 9
    SHAPE_B = 10
    ALLOWANCE = 11  #: the shapes' allowances leave it open; no search narrows it
    MEMORY = 12  #: only in C: too little working memory was given


class Code(Named):
    """What an Error says went wrong."""

    OK = 0
    MEMORY = 1
    ARGUMENT = 2
    NOT_FINITE = 3
    EMPTY = 4
    RANGE = 5
    RADIUS = 6
    ROTATION = 7
    INDEX = 8
    NOT_CONVEX = 9
    HULL = 10
    FORMAT = 11
    FILE = 12
    LIMIT = 13
    PROOF = 14


class ProofKind(Named):
    """What an upper bound rests on."""

    NONE = 0
    POINTS = 1
    HULL = 2
    INNER = 3
    INNER_POINTS = 4
    COVER = 5
    BALLS = 6


class ImpactStatus(Named):
    """What a query about two moving bodies proves."""

    UNDECIDED = 0
    FREE = 1  #: never within the margin, proven
    HIT = 2  #: within the margin at hit_at, proven


class RobotStatus(Named):
    """What is proven of a state or a path of a robot."""

    UNDECIDED = 0  #: treat it as a hit
    FREE = 1  #: every pair is farther apart than the margin, proven
    HIT = 2  #: a pair is within the margin, proven
    REFUSED = 3  #: it is no state


class Touch(Named):
    """What is known of two links over all states within the limits."""

    OPEN = 0
    NEVER = 1  #: proven
    SAMPLED_NEVER = 2
    ALWAYS = 3  #: proven
    SAMPLED_ALWAYS = 4
    SOMETIMES = 5  #: proven
    RIGID = 6  #: nothing but fixed joints between them

    def __str__(self) -> str:
        return self.name.lower().replace("_", " ")


class Inside(Named):
    """What is inside, where that is what proves that two solids overlap."""

    NONE = 0
    A = 1  #: a component of a is inside b
    B = 2  #: a component of b is inside a
    POINT = 3  #: a point is in both, away from their surfaces


class Agreement(Named):
    """What a robot and a model of it say of a state."""

    OPEN = 0  #: one of the two is undecided, or refuses it
    BOTH_FREE = 1
    BOTH_HIT = 2
    MISSED = 3  #: proven: the robot hits, and its model is free
    INVENTED = 4  #: proven: the robot is free, and its model hits

    def __str__(self) -> str:
        return self.name.lower().replace("_", " ")


class Axis(Named):
    """What the normal of a contact is made of."""

    NONE = 0  #: no contact: proven farther apart than the margin
    FACE_A = 1  #: the normal of a facet of a
    FACE_B = 2  #: minus the normal of a facet of b
    EDGES = 3  #: orthogonal to an edge of each
    FREE = 4  #: between the nearest points of two features, or a direction that a search found

    def __str__(self) -> str:
        return self.name.lower().replace("_", " ")


class ManifoldProof(Named):
    """What the upper bound of a contact rests on."""

    NONE = 0
    POINTS = 1  #: its points
    FACETS = 2  #: the facets that meet
    SEARCH = 3  #: the surface that a search found, now or earlier
    NORMAL = 4  #: of a Solid: its points, along the normal alone


class Error(ValueError):
    """What the library refused: its sentence, with code (a Code) and place.

    place: the 0-based vertex, face or item, or the 1-based line of a file; -1 where none applies.
    """

    def __init__(self, sentence: str, code: Code = Code.ARGUMENT, place: int = -1) -> None:
        super().__init__(sentence)
        self.code = code
        self.place = place

    def __reduce__(self) -> tuple[type, tuple[str, Code, int]]:
        return Error, (self.args[0], self.code, self.place)
