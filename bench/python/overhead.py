"""What Python adds to a query: the same bits asked in C and in Python, in turns, the least of many rounds.

overhead.py LIBRARY: that of overhead.c. Prints a table; a call should add at most 0.3 us, a batch of 10 000 at most 1 %.
"""

import ctypes
import random
import sys
import time
from array import array

import ovoid

KINDS = {"collide": 0, "distance": 2, "depth": 3}
COUPLES = 10000


class Body(ctypes.Structure):
    _fields_ = [("bytes", ctypes.c_char_p), ("size", ctypes.c_size_t), ("pose", ctypes.c_double * 7)]


class Batch(ctypes.Structure):
    _fields_ = [("bodies", ctypes.POINTER(Body)), ("body_count", ctypes.c_size_t), ("couples", ctypes.c_void_p),
                ("couple_count", ctypes.c_size_t), ("verdicts", ctypes.c_void_p)]


def make_rock(count):
    return ovoid.Shape.from_points([[random.gauss(0, 1) for _ in range(3)] for _ in range(count)])


def make_pose(spread):
    return ovoid.Pose.from_quaternion([random.uniform(-spread, spread) for _ in range(3)],
                                      wxyz=[random.gauss(0, 1) for _ in range(4)])


def make_given(shapes, poses):
    data = [shape.to_bytes() for shape in shapes]
    bodies = [Body(b, len(b), (ctypes.c_double * 7)(*p.xyz, *p.wxyz)) for b, p in zip(data, poses)]
    return (Body * len(bodies))(*bodies)


def measure_calls(library):
    """Nanoseconds a call of a pair of boxes that are far apart, near, and in each other."""
    print("| call | poses | C, ns | Python, ns | more, ns |\n|---|---|---:|---:|---:|")
    a, b = make_rock(20), make_rock(20)
    for kind, gap in (("collide", 20), ("distance", 4), ("depth", 1)):
        place = ovoid.Pose.from_quaternion((gap, 0.1, 0.2), wxyz=(1, 0.2, 0.3, 0.4))
        given = make_given((a, b), (ovoid.Pose(), place))
        query, here = getattr(ovoid, kind), ovoid.Pose()
        for words, pose_a, pose_b in (("Pose", here, place), ("4x4 array", here.matrix, place.matrix)):
            in_c, in_python = [], []
            for _ in range(30):
                in_c.append(library.time_single(KINDS[kind], given, 3000) / 3000)
                begin = time.perf_counter()
                for _ in range(3000):
                    query(a, b, pose_a, pose_b)
                in_python.append((time.perf_counter() - begin) / 3000)
            c, python = min(in_c) * 1e9, min(in_python) * 1e9
            print(f"| {kind} | {words} | {c:.0f} | {python:.0f} | {python - c:.0f} |")


def measure_batches(library):
    """Microseconds of a batch of 10 000 couples into arrays that are there."""
    print(f"\n| batch of {COUPLES} | C, us | Python, us | more, % |\n|---|---:|---:|---:|")
    shapes = [make_rock(20) for _ in range(300)]
    poses = [make_pose(6) for _ in shapes]
    couples = array("I", [random.randrange(300) for _ in range(2 * COUPLES)])
    given = make_given(shapes, poses)
    bodies = ovoid.Bodies(shapes, poses)
    pairs = memoryview(couples).cast("B").cast("I", (COUPLES, 2))
    out = ovoid.zeros("verdicts", COUPLES)
    verdicts = (ctypes.c_char * (32 * COUPLES))()
    batch = Batch(given, 300, ctypes.c_void_p(couples.buffer_info()[0]), COUPLES, ctypes.addressof(verdicts))
    for kind in KINDS:
        query = getattr(ovoid, kind + "_batch")
        in_c, in_python, times = [], [], (ctypes.c_double * 3)()
        for _ in range(20 if kind == "depth" else 60):
            in_c.append(library.time_batch(KINDS[kind], ctypes.byref(batch), 3, times))
            for _ in range(3):
                begin = time.perf_counter()
                query(bodies, pairs, out=out)
                in_python.append(time.perf_counter() - begin)
        assert bytes(memoryview(out).cast("B")) == bytes(verdicts), "not the same bits"
        c, python = min(in_c) * 1e6, min(in_python) * 1e6
        print(f"| {kind} | {c:.0f} | {python:.0f} | {100 * (python / c - 1):.2f} |")


def main():
    random.seed(3)
    library = ctypes.CDLL(sys.argv[1])
    library.time_single.restype = library.time_batch.restype = ctypes.c_double
    library.time_single.argtypes = [ctypes.c_int, ctypes.POINTER(Body), ctypes.c_size_t]
    library.time_batch.argtypes = [ctypes.c_int, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p]
    measure_calls(library)
    measure_batches(library)


if __name__ == "__main__":
    main()
