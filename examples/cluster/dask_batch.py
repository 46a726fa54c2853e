"""dask_batch.py: poses of a pair as an array, mapped over processes by Dask, with the answers of one process.

A cluster of machines takes the place of LocalCluster: Client("scheduler:8786"); ovoid and the shapes go to the workers
as any Python object does."""

import sys

import dask.array
import numpy
import ovoid
from dask.distributed import Client, LocalCluster

def make_poses(count):
    """(count, 7): positions, and quaternions wxyz, on a coil around the origin."""
    t = numpy.linspace(0, 40, count)
    half = t / 3
    return numpy.stack([2 * numpy.cos(t), 2 * numpy.sin(t), t / 40, numpy.cos(half), numpy.sin(half), 0 * t, 0 * t], 1)


def measure(poses, tool, part):
    """The brackets of the signed distance of the tool, at each of the poses, to the part: two columns."""
    bodies = ovoid.Bodies([part] + [tool] * len(poses), numpy.vstack([[0, 0, 0, 1, 0, 0, 0], poses]), order="wxyz")
    couples = numpy.stack([numpy.zeros(len(poses), "u4"), numpy.arange(1, len(poses) + 1, dtype="u4")], 1)
    verdicts = ovoid.depth_batch(bodies, couples)
    return numpy.stack([verdicts["lower"], verdicts["upper"]], 1)


def main(count):
    tool = ovoid.Shape.from_points([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    part = ovoid.Shape.from_points([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    poses = make_poses(count)
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with Client(cluster):
            chunks = dask.array.from_array(poses, chunks=(max(1, count // 8), 7))
            answers = chunks.map_blocks(measure, tool, part, dtype="f8", chunks=(chunks.chunks[0], (2,))).compute()
    assert answers.tobytes() == measure(poses, tool, part).tobytes(), "other answers than those of one process"
    print(f"{count} poses in {chunks.numblocks[0]} chunks, {int((answers[:, 0] <= 0).sum())} touch or overlap")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20000)
