"""mpi_batch.py: the same with MPI: mpirun -n 4 python3 mpi_batch.py. Each rank answers its rows, rank 0 has them all.
MPI is not in the library: a rank needs nothing but its part of an array."""

import sys

import numpy
from dask_batch import make_poses, measure
from mpi4py import MPI
import ovoid


def main(count):
    world = MPI.COMM_WORLD
    tool = ovoid.Shape.from_points([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    part = ovoid.Shape.from_points([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    poses = make_poses(count)
    rows = numpy.array_split(numpy.arange(count), world.size)
    mine = measure(poses[rows[world.rank]], tool, part)
    answers = numpy.empty((count, 2)) if world.rank == 0 else None
    counts = [2 * len(r) for r in rows]
    world.Gatherv(mine, (answers, counts) if world.rank == 0 else None, root=0)
    if world.rank == 0:
        assert answers.tobytes() == measure(poses, tool, part).tobytes(), "other answers than those of one process"
        print(f"{count} poses on {world.size} ranks, {int((answers[:, 0] <= 0).sum())} touch or overlap")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20000)
