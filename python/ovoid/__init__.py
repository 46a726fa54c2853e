"""Proximity of convex bodies, with proofs.

Do two bodies touch, how far apart are they, how deep do they overlap, when do they meet. Every answer is a bracket that
is true, rounding included, and carries a proof that verify() checks.

    >>> import ovoid
    >>> box = ovoid.Shape.box((1, 2, 3))
    >>> pill = ovoid.Shape.capsule(0.5, 1)
    >>> answer = ovoid.distance(box, pill, None, ovoid.Pose.from_rpy((4, 0, 0), (0, 0.7, 0)))
    >>> str(answer.status), answer.lower <= 1.8557823127 + 1e-9
    ('separated', True)
    >>> ovoid.verify(answer)

Lengths are in the caller's unit, the same everywhere; angles are radians; poses are in the world frame. Results are NumPy
arrays where NumPy can be imported.
"""

from ._enums import (Agreement, Axis, Code, Error, ImpactStatus, Inside, Limit, ManifoldProof, ProofKind, RobotStatus, Stage,
                     Status, Touch)
from ._ovoid import *  # noqa: F403
from ._ovoid import __version__, has_io, has_robot
from . import _faces, _pickle
from ._draw import Picture, draw
from ._page import show
from ._planning import Plan
from ._values import (Cast, Clearance, Comparison, Contacts, Element, Hit, Joint, ManifoldPolygon, Material, MatrixPair,
                      MotionRequest, Obstacle, PartsAudit, Side, SphereAudit, StateAnswer, SweptAnswer, Trajectory, Variable,
                      WorldManifolds)


if not has_io:

    def read(path, **options):
        """Reads a file, in a build that has libovoid_io."""
        raise Error("this build of ovoid reads no files: it was built without libovoid_io", Code.FILE)


__all__ = [name for name in dir() if not name.startswith("_")]

_ELSEWHERE = {"load": "read", "save": "Shape.write", "check": "verify", "load_parts": "read_parts", "plot": "draw", "view": "show"}


def __getattr__(name):
    meant = _ELSEWHERE.get(name)
    raise AttributeError(f"module 'ovoid' has no attribute {name!r}" + (f": it is named ovoid.{meant}" if meant else ""))
