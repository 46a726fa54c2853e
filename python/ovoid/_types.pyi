# The names that the signatures use, for type checkers alone: there is no such module when a program runs.
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, Protocol, SupportsIndex, TypeAlias

import numpy as np
import numpy.typing as npt

from . import Compound, Motion, Pose, Shape, Solid

class Rotation(Protocol):
    """A rotation as SciPy has it."""
    def as_quat(self) -> Any: ...

class HasVertices(Protocol):
    """A mesh as trimesh has it: points (n, 3)."""
    @property
    def vertices(self) -> Any: ...

class HasFaces(HasVertices, Protocol):
    """Triangles (m, 3) too."""
    @property
    def faces(self) -> Any: ...

# Results. Without NumPy they are of the class Array instead; docstrings have the shapes and the records' fields.
Floats: TypeAlias = npt.NDArray[np.float64]
Indices: TypeAlias = npt.NDArray[np.uint32]
Ids: TypeAlias = npt.NDArray[np.uint64]
Records: TypeAlias = npt.NDArray[np.void]

# Arguments.
Numbers: TypeAlias = Any  # a buffer, what has __array__, or nested sequences of numbers
Vec3: TypeAlias = tuple[float, float, float]
Vec4: TypeAlias = tuple[float, float, float, float]
Box: TypeAlias = tuple[Vec3, Vec3]
Body: TypeAlias = Shape | Compound | Solid
PoseLike: TypeAlias = Pose | tuple[Numbers, Rotation | Numbers] | tuple[Rotation, Numbers] | Numbers | None
PosesLike: TypeAlias = Sequence[PoseLike] | Numbers
MotionLike: TypeAlias = Motion | PoseLike
Order: TypeAlias = Literal["wxyz", "xyzw"] | None
Allowance: TypeAlias = tuple[float, float] | tuple[float, float, Vec3]
StateLike: TypeAlias = str | Mapping[str, float] | Numbers  # the name of a state, a dict by variables' names, or numbers
StatesLike: TypeAlias = Sequence[StateLike] | StateLike
LinkLike: TypeAlias = str | SupportsIndex  # a name or an index
PathLike: TypeAlias = str | bytes | os.PathLike[str]
Progress: TypeAlias = Callable[[int, int], object]
