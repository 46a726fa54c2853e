# Types of the package; docstrings have the words. Arrays are numpy.ndarray where NumPy can be imported, else Array.
import os
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Final, Literal, NamedTuple, Protocol, SupportsIndex, TypeAlias

from ._enums import Agreement as Agreement
from ._enums import Code as Code
from ._enums import Error as Error
from ._enums import ImpactStatus as ImpactStatus
from ._enums import Inside as Inside
from ._enums import Limit as Limit
from ._enums import ProofKind as ProofKind
from ._enums import RobotStatus as RobotStatus
from ._enums import Stage as Stage
from ._enums import Status as Status
from ._enums import Touch as Touch

class _Rotation(Protocol):
    def as_quat(self) -> Any: ...

class _HasVertices(Protocol):
    @property
    def vertices(self) -> Any: ...

class _HasFaces(_HasVertices, Protocol):
    @property
    def faces(self) -> Any: ...

_Numbers: TypeAlias = Any  # a buffer, what has __array__, or nested sequences of numbers
_Pose: TypeAlias = Pose | tuple[_Numbers, _Rotation] | _Numbers | None
_Poses: TypeAlias = Sequence[_Pose] | _Numbers
_Order: TypeAlias = Literal["wxyz", "xyzw"] | None
_Allowance: TypeAlias = tuple[float, float] | tuple[float, float, tuple[float, float, float]]
_Inner: TypeAlias = Literal["maximum", "phases"]
_Vec3: TypeAlias = tuple[float, float, float]
_Box: TypeAlias = tuple[_Vec3, _Vec3]
_Convex: TypeAlias = Shape | Compound
_Body: TypeAlias = Shape | Compound | Solid
_Progress: TypeAlias = Callable[[int, int], object]
_Link: TypeAlias = str | SupportsIndex
_Path: TypeAlias = str | bytes | os.PathLike[str]
_Moving: TypeAlias = Motion | _Pose

__version__: str
has_io: int
has_robot: int

class Array:
    def __len__(self) -> int: ...
    def __getitem__(self, key: Any, /) -> Any: ...
    def __buffer__(self, flags: int, /) -> memoryview: ...
    def tolist(self) -> list[Any]: ...

_Array: TypeAlias = Any  # numpy.ndarray or Array

class Ellipsoid:
    center: Final[_Vec3]
    matrix: Final[_Array]
    volume: Final[float]
    gap: Final[float]
    radii: Final[_Vec3]

class Shape:
    @classmethod
    def from_points(cls, points: _Numbers, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0)) -> Shape: ...
    @classmethod
    def hull_of(cls, mesh: _HasVertices, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0)) -> Shape: ...
    @classmethod
    def from_faces(cls, vertices: _Numbers, faces: _Numbers, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0)) -> Shape: ...
    @classmethod
    def box(cls, half_sizes: _Numbers, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0)) -> Shape: ...
    @classmethod
    def sphere(cls, radius: float, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0)) -> Shape: ...
    @classmethod
    def capsule(cls, radius: float, half_length: float, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0)) -> Shape: ...
    @classmethod
    def cylinder(cls, radius: float, half_length: float, tolerance: float = 0, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0)) -> Shape: ...
    @classmethod
    def cone(cls, radius: float, half_length: float, tolerance: float = 0, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0)) -> Shape: ...
    @classmethod
    def prism(cls, radius: float, half_length: float, sides: int, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0)) -> Shape: ...
    @classmethod
    def pyramid(cls, radius: float, half_length: float, sides: int, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0)) -> Shape: ...
    @classmethod
    def from_bytes(cls, data: Any, /) -> Shape: ...
    @classmethod
    def read(cls, path: str | bytes | os.PathLike[str], scale: float = 1, unit: str | None = None, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0), hull: bool = False) -> Shape: ...
    def to_bytes(self) -> bytes: ...
    def write(self, path: str | bytes | os.PathLike[str], /) -> None: ...
    def divided(self, normal: _Numbers, offset: float, *, rounding: float = 0) -> tuple[Shape | None, Shape | None]: ...
    def deformed(self, points: _Numbers, *, rounding: float = 0) -> Shape: ...
    vertices: Final[_Array]
    faces: Final[_Array]
    volume: Final[float]
    area: Final[float]
    centroid: Final[_Vec3]
    inertia: Final[_Array]
    bounds: Final[_Box]
    outer: Final[Ellipsoid]
    inner: Final[Ellipsoid]
    radius: Final[float]
    allowance: Final[tuple[float, float]]
    allowance_axis: Final[tuple[float, float, float] | None]
    rank: Final[int]
    report: Final[dict[str, int]]

class Solid:
    @classmethod
    def from_triangles(cls, vertices: _Numbers, faces: _Numbers) -> Solid: ...
    @classmethod
    def from_mesh(cls, mesh: _HasFaces, /) -> Solid: ...
    @classmethod
    def read(cls, path: _Path, scale: float = 1, unit: str | None = None) -> Solid: ...
    def match_hull(self) -> Shape | None: ...
    def winding(self, point: _Numbers, /) -> int | None: ...
    def crossings(self, most: int = ...) -> tuple[int, bool, tuple[int, int] | None]: ...
    def decompose(self, *, error: float = 0, parts: int = 0, progress: _Progress | None = None) -> tuple[Shape, ...]: ...
    def audit_parts(self, parts: Iterable[Shape], *, tolerance: float = 0, cells: int = 0, work: int = 0, progress: _Progress | None = None) -> PartsAudit: ...
    vertices: Final[_Array]
    faces: Final[_Array]
    order: Final[_Array]
    kind: Final[Literal["solid", "surface"]]
    is_closed: Final[bool]
    volume: Final[float]
    area: Final[float]
    bounds: Final[_Box]
    report: Final[dict[str, int]]

class PartsAudit(NamedTuple):
    uncovered: tuple[float, float]
    excess: tuple[float, float]
    uncovered_point: _Vec3
    uncovered_part: int
    excess_point: _Vec3
    excess_part: int
    excess_of_parts: _Array
    cells: int

def enlarge_parts(parts: Iterable[Shape], radius: float) -> tuple[Shape, ...]: ...

class Pose:
    def __new__(cls, pose: _Pose = None) -> Pose: ...
    @classmethod
    def from_translation(cls, xyz: _Numbers) -> Pose: ...
    @classmethod
    def from_quaternion(cls, xyz: _Numbers, *, wxyz: _Numbers = ..., xyzw: _Numbers = ...) -> Pose: ...
    @classmethod
    def from_rotation(cls, xyz: _Numbers, rotation: _Rotation | _Numbers) -> Pose: ...
    @classmethod
    def from_rpy(cls, xyz: _Numbers, rpy: _Numbers) -> Pose: ...
    @classmethod
    def from_axis_angle(cls, xyz: _Numbers, axis: _Numbers, angle: float) -> Pose: ...
    def inverse(self) -> Pose: ...
    def apply(self, points: _Numbers, /) -> _Array: ...
    def apply_inverse(self, points: _Numbers, /) -> _Array: ...
    def __matmul__(self, other: Pose, /) -> Pose: ...
    xyz: Final[_Vec3]
    wxyz: Final[tuple[float, float, float, float]]
    xyzw: Final[tuple[float, float, float, float]]
    matrix: Final[_Array]

class Compound:
    def __new__(cls, shapes: Sequence[Shape], poses: _Poses | None = None, *, order: _Order = None) -> Compound: ...
    def __len__(self) -> int: ...
    shapes: Final[tuple[Shape, ...]]
    poses: Final[tuple[Pose, ...]]
    outer: Final[Ellipsoid]
    inner: Final[Ellipsoid]
    order: Final[_Array]

class Answer:
    status: Final[Status]
    lower: Final[float]
    upper: Final[float]
    point_a: Final[_Vec3]
    point_b: Final[_Vec3]
    normal: Final[_Vec3]
    limit: Final[Limit]
    stage: Final[Stage]
    iterations: Final[int]
    part_a: Final[int]
    part_b: Final[int]
    visited: Final[int]
    tested: Final[int]
    surfaces_lower: Final[float | None]
    surfaces_upper: Final[float | None]
    inside: Final[Inside | None]
    component: Final[int | None]
    common: Final[_Vec3 | None]
    parting: Final[_Vec3 | None]
    distance: Final[float]
    proof: Final[_Array]
    a: Final[_Body]
    b: Final[_Body]
    pose_a: Final[Pose]
    pose_b: Final[Pose]
    def is_within(self, margin: float, /) -> bool | None: ...

class Bodies:
    def __new__(cls, shapes: Sequence[_Body] | _Body, poses: _Poses, *, order: _Order = None) -> Bodies: ...
    def __len__(self) -> int: ...
    def move(self, poses: _Poses, *, order: _Order = None) -> None: ...

class Contacts(NamedTuple):
    items: _Array
    witnesses: _Array | None
    bodies: int
    pairs: int
    aged: int
    queried: int
    added: int
    dropped: int
    moved: int
    rebuilt: bool
    memory: int

class Hit(NamedTuple):
    a: int
    b: int
    lower: float
    answer: Answer

class Cast(NamedTuple):
    body: int
    part: int
    probe: int
    lower: float
    upper: float
    point: _Vec3
    normal: _Vec3
    undecided: int

class World:
    def __new__(cls, *, threads: int = 1, enlargement: float = 0) -> World: ...
    def __len__(self) -> int: ...
    def add(self, body: _Body, pose: _Pose = None, *, group: int = 0, mask: int = 0) -> int: ...
    def add_many(self, bodies: Sequence[_Body], poses: _Poses, *, order: _Order = None, group: int = 0, mask: int = 0) -> _Array: ...
    def remove(self, id: SupportsIndex, /) -> None: ...
    def remove_many(self, ids: _Numbers, /) -> None: ...
    def move(self, id: SupportsIndex, pose: _Pose, /) -> None: ...
    def move_many(self, ids: _Numbers, poses: _Poses, *, order: _Order = None) -> None: ...
    def pose(self, id: SupportsIndex, /) -> Pose: ...
    def body(self, id: SupportsIndex, /) -> _Body: ...
    def ids(self) -> _Array: ...
    def set_groups(self, id: SupportsIndex, group: int, mask: int, /) -> None: ...
    def set_ignored(self, a: SupportsIndex, b: SupportsIndex, ignored: bool = True, /) -> None: ...
    def is_pair(self, a: SupportsIndex, b: SupportsIndex, /) -> bool: ...
    def contacts(self, kind: Literal["collide", "within", "distance", "depth"] = "distance", margin: float = 0, *, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0) -> Contacts: ...
    def proof(self, a: SupportsIndex, b: SupportsIndex, /) -> Answer: ...
    def nearest(self, id: SupportsIndex, *, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0) -> Hit | None: ...
    def nearest_to(self, body: _Body, pose: _Pose = None, *, group: int = 0, mask: int = 0, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0) -> Hit | None: ...
    def nearest_pair(self, *, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0) -> Hit | None: ...
    def find_any(self, ids: _Numbers | None = None, /) -> Hit | None: ...
    def find_any_to(self, bodies: Sequence[_Body], poses: _Poses, *, order: _Order = None) -> Hit | None: ...
    def find_any_of(self, bodies: Sequence[_Body], poses: _Poses, couples: _Numbers, *, order: _Order = None) -> Hit | None: ...
    def overlaps(self, body: _Body, pose: _Pose = None, *, margin: float = 0, group: int = 0, mask: int = 0, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0) -> list[Hit]: ...
    def cast_ray(self, origin: _Numbers, direction: _Numbers, length: float = ..., *, radius: float = 0, group: int = 0, mask: int = 0) -> Cast: ...
    def cast_body(self, body: _Body, pose: _Pose, displacement: _Numbers, *, group: int = 0, mask: int = 0) -> Cast: ...

class Motion:
    @classmethod
    def still(cls, pose: _Pose, /) -> Motion: ...
    @classmethod
    def velocity(cls, start: _Pose, linear: _Numbers, angular: _Numbers, duration: float, *, pivot: _Numbers = (0, 0, 0)) -> Motion: ...
    @classmethod
    def poses(cls, start: _Pose, end: _Pose, duration: float = 1) -> Motion: ...
    @classmethod
    def path(cls, times: _Numbers, poses: _Poses, *, order: _Order = None) -> Motion: ...
    def pose(self, time: float, /) -> Pose: ...
    def swept(self, body: _Body, begin: float, end: float, /) -> _Box: ...

class Impact:
    status: Final[ImpactStatus]
    limit: Final[Limit]
    free_until: Final[float]
    hit_at: Final[float]
    begin: Final[float]
    end: Final[float]
    iterations: Final[int]
    part_a: Final[int]
    part_b: Final[int]
    margin: Final[float]
    free: Final[Answer | None]
    hit: Final[Answer | None]
    steps: Final[_Array]

class Approach:
    status: Final[Status]
    limit: Final[Limit]
    lower: Final[float]
    upper: Final[float]
    time: Final[float]
    begin: Final[float]
    end: Final[float]
    iterations: Final[int]
    answer: Final[Answer]
    steps: Final[_Array]

class RayHit:
    status: Final[ImpactStatus]
    limit: Final[Limit]
    lower: Final[float]
    upper: Final[float]
    point: Final[_Vec3]
    normal: Final[_Vec3]

class SmoothValue:
    value: Final[float]
    error: Final[float]
    condition: Final[float]
    is_smooth: Final[bool]
    point_a: Final[_Vec3]
    point_b: Final[_Vec3]
    normal: Final[_Vec3]
    gradient: Final[_Array]
    hessian: Final[_Array]

class Smooth:
    outer: Final[SmoothValue]
    inner: Final[SmoothValue]

class Gradient:
    gradient: Final[_Array]
    has_translation: Final[bool]
    has_rotation: Final[bool]
    turn: Final[float]
    slope: Final[float]
    slide: Final[float]
    margin: Final[float]

def read(path: str | bytes | os.PathLike[str], *, scale: float = 1, unit: str | None = None, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0), hull: bool = False) -> Shape | Solid: ...
def collide(a: _Body | Prepared, b: _Body | Prepared, pose_a: _Pose = None, pose_b: _Pose = None, *, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0, earlier: Answer | _Array | None = None) -> Answer: ...
def within(a: _Body | Prepared, b: _Body | Prepared, pose_a: _Pose = None, pose_b: _Pose = None, *, margin: float, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0, earlier: Answer | _Array | None = None) -> Answer: ...
def distance(a: _Body | Prepared, b: _Body | Prepared, pose_a: _Pose = None, pose_b: _Pose = None, *, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0, earlier: Answer | _Array | None = None) -> Answer: ...
def depth(a: _Convex | Prepared, b: _Convex | Prepared, pose_a: _Pose = None, pose_b: _Pose = None, *, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0, earlier: Answer | _Array | None = None) -> Answer: ...
def collide_batch(bodies: Bodies, couples: _Numbers, *, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0, threads: int = 1, out: _Array | None = None, witnesses: bool | _Array = False, proofs: _Array | None = None, progress: _Progress | None = None) -> Any: ...
def within_batch(bodies: Bodies, couples: _Numbers, margin: float, *, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0, threads: int = 1, out: _Array | None = None, witnesses: bool | _Array = False, proofs: _Array | None = None, progress: _Progress | None = None) -> Any: ...
def distance_batch(bodies: Bodies, couples: _Numbers, *, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0, threads: int = 1, out: _Array | None = None, witnesses: bool | _Array = False, proofs: _Array | None = None, progress: _Progress | None = None) -> Any: ...
def depth_batch(bodies: Bodies, couples: _Numbers, *, absolute_tolerance: float = 0, relative_tolerance: float = 0, cap: float = 0, iterations: int = 0, threads: int = 1, out: _Array | None = None, witnesses: bool | _Array = False, proofs: _Array | None = None, progress: _Progress | None = None) -> Any: ...
def zeros(kind: Literal["verdicts", "witnesses", "proofs", "states"], count: int, /) -> _Array: ...
def verify(answer: Answer | Impact | Approach | RobotPath, /) -> None: ...
def is_proven(answer: Answer | Impact | Approach | RobotPath, /) -> bool: ...
def find_impact(a: _Body, b: _Body, motion_a: _Moving = None, motion_b: _Moving = None, *, margin: float = 0, begin: float = 0, end: float = 0, tolerance: float = 0, iterations: int = 0) -> Impact: ...
def find_approach(a: Shape, b: Shape, motion_a: _Moving = None, motion_b: _Moving = None, *, begin: float = 0, end: float = 0, tolerance: float = 0, iterations: int = 0) -> Approach: ...
def cast_ray(shape: Shape, pose: _Pose, origin: _Numbers, direction: _Numbers, length: float = ..., *, radius: float = 0) -> RayHit: ...
def smooth(a: Shape, b: Shape, pose_a: _Pose = None, pose_b: _Pose = None, *, order: Literal[0, 1, 2] = 1) -> Smooth: ...
def gradient(answer: Answer, /) -> Gradient: ...

class Prepared:
    def __new__(cls, shape: Shape, pose: _Pose = None) -> Prepared: ...
    shape: Final[Shape]
    pose: Final[Pose]

class Joint(NamedTuple):
    name: str
    type: str
    parent: str
    child: str
    origin: _Pose = ...
    axis: _Vec3 = ...
    lower: float = ...
    upper: float = ...
    velocity: float = ...
    mimic: str | None = ...
    multiplier: float = ...
    offset: float = ...

class Variable(NamedTuple):
    name: str
    joint: str
    component: int
    lower: float
    upper: float
    velocity: float

class Element(NamedTuple):
    link: str
    shape: Shape
    pose: _Pose = ...
    name: str | None = ...

class Side(NamedTuple):
    link: int | None
    element: int | None
    body: int
    part: int

class StateAnswer(NamedTuple):
    status: RobotStatus
    a: Side | None
    b: Side | None
    lower: float
    upper: float
    code: Code | None
    variable: int | None

class MatrixPair(NamedTuple):
    a: str
    b: str
    touch: Touch
    is_neighbour: bool
    samples: int
    hits: int
    frees: int
    cells: int
    hit: _Array | None
    free: _Array | None
    reason: str | None
    sampled_reason: str | None

class SphereAudit(NamedTuple):
    depth: tuple[float, float]
    point: _Vec3
    element: int
    sphere: int
    uncovered: tuple[float, float]
    excess: tuple[float, float]
    link: tuple[float, float]
    spheres: tuple[float, float]
    cells: int

class Clearance(NamedTuple):
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

class Comparison(NamedTuple):
    counts: dict[Agreement, int]
    agreements: _Array
    deepest_state: int | None
    deepest: _Array | None

class Obstacle(NamedTuple):
    name: str
    shape: Shape
    pose: Pose
    solid: Solid | None
    frame: str | None
    link: str | None

class MotionRequest(NamedTuple):
    group: str
    start: dict[str, float]
    goals: list[dict[str, float]]

class Robot:
    def __new__(cls, links: Sequence[str], joints: Sequence[Joint], elements: Sequence[tuple[Any, ...]] = (), disabled: Sequence[tuple[str, str]] = (), *, name: str | None = None) -> Robot: ...
    @classmethod
    def read(cls, urdf: _Path, srdf: _Path | None = None, *, packages: dict[str, _Path] | None = None, parts: bool = False, visual: bool = False, solids: bool = True, scales: dict[str | None, float] | None = None, fixed_base: bool = False, tolerance: float = 0) -> Robot: ...
    def poses(self, q: _Numbers, *, order: _Order = None) -> _Array: ...
    def pose_errors(self, q: _Numbers, /) -> _Array: ...
    def validate_limits(self, q: _Numbers, slack: float = 0) -> None: ...
    def is_rigid_pair(self, a: _Link, b: _Link, /) -> bool: ...
    def find_link(self, name: _Link, /) -> int: ...
    def find_joint(self, name: str, /) -> int: ...
    def parent_joint(self, link: _Link, /) -> int | None: ...
    def joint_variable(self, joint: str, /) -> int | None: ...
    def compute_matrix(self, *, samples: int = 0, budget: int = 0, seed: int = 0) -> tuple[MatrixPair, ...]: ...
    def with_spheres(self, spheres: Sequence[tuple[_Link, _Numbers, float]], /) -> Robot: ...
    def audit_spheres(self, link: _Link, spheres: _Numbers, *, tolerance: float = 0, depth_cells: int = 0, volume_cells: int = 0, without_volumes: bool = False) -> SphereAudit: ...
    def cover_spheres(self, link: _Link, count: int, *, excess: float = 0, rounds: int = 0, seed: int = 0) -> tuple[_Array, tuple[float, float]]: ...
    name: Final[str | None]
    root: Final[str]
    links: Final[tuple[str, ...]]
    joints: Final[tuple[Joint, ...]]
    variables: Final[tuple[Variable, ...]]
    elements: Final[tuple[Element, ...]]
    disabled: Final[tuple[tuple[str, str, str | None], ...]]
    lower: Final[_Array]
    upper: Final[_Array]
    groups: Final[tuple[tuple[str, tuple[str, ...], tuple[str, ...]], ...]]
    states: Final[tuple[tuple[str, str, dict[str, tuple[float, ...]]], ...]]
    spheres: Final[tuple[tuple[str, _Vec3, float], ...]]
    passive: Final[tuple[str, ...]]
    meshes: Final[tuple[dict[str, Any], ...]]
    ignored: Final[tuple[tuple[str, int], ...]]
    fixed_mimics: Final[int]

class Cell:
    def __new__(cls, robot: Robot) -> Cell: ...
    def add(self, body: _Body, pose: _Pose = None) -> int: ...
    def attach(self, link: _Link, body: _Body, pose: _Pose = None, touching: Sequence[_Link] = ()) -> int: ...
    def remove(self, id: int, /) -> None: ...
    def move(self, id: int, pose: _Pose, /) -> None: ...
    def allow(self, a: _Link, b: _Link, allowed: bool = True) -> None: ...
    def allow_body(self, id: int, link: _Link, allowed: bool = True) -> None: ...
    def set_padding(self, link: _Link, padding: float) -> None: ...
    def is_allowed(self, a: _Link, b: _Link) -> bool: ...
    def is_body_allowed(self, id: int, link: _Link) -> bool: ...
    def get_padding(self, link: _Link, /) -> float: ...
    def pair(self, number: int, /) -> tuple[Side, Side]: ...
    def reset(self) -> None: ...
    def read(self, path: _Path, tolerance: float = 0, *, solids: bool = True, paddings: dict[str | None, float] | None = None) -> list[tuple[str, int]]: ...
    def collide(self, q: _Numbers, *, margin: float = 0, limit_slack: float = 0, without_self: bool = False, without_obstacles: bool = False) -> StateAnswer: ...
    def collide_batch(self, q: _Numbers, *, margin: float = 0, limit_slack: float = 0, without_self: bool = False, without_obstacles: bool = False, threads: int = 1, out: _Array | None = None, progress: _Progress | None = None) -> _Array: ...
    def near(self, q: _Numbers, margin: float, *, limit_slack: float = 0, without_self: bool = False, without_obstacles: bool = False, without_depths: bool = False) -> tuple[_Array, _Array]: ...
    def nearest(self, q: _Numbers, *, margin: float = ..., limit_slack: float = 0, without_self: bool = False, without_obstacles: bool = False) -> tuple[_Array, _Array]: ...
    def nearest_batch(self, q: _Numbers, *, margin: float = ..., limit_slack: float = 0, without_self: bool = False, without_obstacles: bool = False, progress: _Progress | None = None) -> tuple[_Array, _Array]: ...
    def find_hit(self, states: _Numbers, *, margin: float = 0, limit_slack: float = 0, without_self: bool = False, without_obstacles: bool = False, tolerance: float = 0, most_states: int = 0, any_hit: bool = False) -> RobotPath: ...
    def clearance(self, states: _Numbers, *, margin: float = 0, limit_slack: float = 0, without_self: bool = False, without_obstacles: bool = False, tolerance: float = 0, most_states: int = 0) -> Clearance: ...
    def read_paths(self, path: _Path, /) -> list[RobotPath]: ...
    robot: Final[Robot]
    bodies: Final[dict[int, _Body]]
    pair_count: Final[int]

class RobotPath:
    status: Final[RobotStatus]
    free_until: Final[float]
    hit_at: Final[float]
    looked_at: Final[int]
    hit: Final[StateAnswer | None]
    refused: Final[int | None]
    steps: Final[_Array]
    states: Final[_Array]
    cell: Final[Cell]

def compare_states(robot: Cell, model: Cell, q: _Numbers, *, margin: float = 0, limit_slack: float = 0, without_self: bool = False, without_obstacles: bool = False, progress: _Progress | None = None) -> Comparison: ...
def read_path_sources(path: _Path, /) -> list[dict[str, Any]]: ...
def read_obstacles(path: _Path, tolerance: float = 0, *, solids: bool = True) -> list[Obstacle]: ...
def read_motion_request(path: _Path, /) -> MotionRequest: ...
def find_problems(folder: _Path, /) -> list[tuple[str, str, str]]: ...
def bounds(a: Shape, b: Shape, pose_a: _Pose = None, pose_b: _Pose = None) -> Answer: ...
def gap(a: Shape, b: Shape, pose_a: _Pose = None, pose_b: _Pose = None, *, direction: _Numbers) -> float: ...
def read_parts(path: _Path, scale: float = 1, unit: str | None = None, *, rounding: float = 0, gap: float = 0, inner: _Inner = "maximum", allowance: _Allowance = (0, 0)) -> list[tuple[str, Shape]]: ...
