"""Batches. Truth: status and bracket of the single query of each couple; the bits of one thread and one kind of array, for all others."""

import os
import random
import signal
import threading
import unittest
from array import array

import common
import ovoid
from common import needs_numpy, numpy

random.seed(7)


def make_rock(count):
    return ovoid.Shape.from_points([[random.gauss(0, 1) for _ in range(3)] for _ in range(count)])


def make_pose(spread):
    return ovoid.Pose.from_quaternion([random.uniform(-spread, spread) for _ in range(3)],
                                      wxyz=[random.gauss(0, 1) for _ in range(4)])


SHAPES = [make_rock(count) for count in (4, 8, 20, 60)] * 15
POSES = [make_pose(6) for _ in SHAPES]
COUPLES = [[random.randrange(len(SHAPES)) for _ in range(2)] for _ in range(1500)]
BODIES = ovoid.Bodies(SHAPES, POSES)
NAMES = ("collide", "within", "distance", "depth")


def ask(name, *arguments, **options):
    """The batch or single query of that name; within has a margin."""
    if name.startswith("within"):
        options["margin"] = 1
    return getattr(ovoid, name)(*arguments, **options)


class Same(unittest.TestCase):
    def check_singles(self, name, verdicts, witnesses):
        for (a, b), verdict, witness in zip(COUPLES, verdicts.tolist(), witnesses.tolist()):
            answer = ask(name, SHAPES[a], SHAPES[b], POSES[a], POSES[b])
            if isinstance(verdict, dict):
                verdict, witness = tuple(verdict.values()), tuple(witness.values())
            status, _, limit, _, lower, upper = verdict
            self.assertEqual(status, answer.status)
            self.assertTrue(lower <= answer.upper and answer.lower <= upper)
            if name == "within":
                self.assertEqual((upper <= 1, lower > 1), (answer.upper <= 1, answer.lower > 1))
            if name in ("distance", "depth"):
                self.assertEqual(limit, answer.limit)
            if name == "distance" and lower > 0:
                # Nearest points are off by at most the root of the bracket's width, some 1e-9, times the size.
                for one, two in zip([*witness[0], *witness[1]], [*answer.point_a, *answer.point_b]):
                    self.assertAlmostEqual(one, two, delta=1e-3)

    def test_as_singles(self):
        for name in NAMES:
            for threads in (1, 3):
                with self.subTest(name=name, threads=threads):
                    self.check_singles(name, *ask(name + "_batch", BODIES, COUPLES, witnesses=True, threads=threads))

    def test_any_threads_and_order(self):
        for name in NAMES:
            wanted = ask(name + "_batch", BODIES, COUPLES, witnesses=True)
            threaded = ask(name + "_batch", BODIES, COUPLES, witnesses=True, threads=3)
            backward = ask(name + "_batch", BODIES, COUPLES[::-1], witnesses=True)
            for one, two, three in zip(wanted, threaded, backward):
                self.assertEqual(bytes(memoryview(one).cast("B")), bytes(memoryview(two).cast("B")))
                size, raw = memoryview(one).nbytes // len(COUPLES), bytes(memoryview(three).cast("B"))
                back = b"".join(raw[i:i + size] for i in reversed(range(0, len(raw), size)))
                self.assertEqual(bytes(memoryview(one).cast("B")), back)

    def test_proofs_warm(self):
        proofs = ovoid.zeros("proofs", len(COUPLES))
        first = ovoid.distance_batch(BODIES, COUPLES, proofs=proofs)
        again = ovoid.distance_batch(BODIES, COUPLES, proofs=proofs)
        warm = 0
        for (a, b), one, two in zip(COUPLES, first.tolist(), again.tolist()):
            one, two = (tuple(x.values()) if isinstance(x, dict) else x for x in (one, two))
            self.assertLessEqual(one[4], two[5])
            self.assertLessEqual(two[4], one[5])
            warm += two[1] == ovoid.Stage.PROOF
        self.assertGreater(warm, len(COUPLES) // 4)

    def test_poses_in_all_ways(self):
        sevens = [[*pose.xyz, *pose.xyzw] for pose in POSES]
        nines = [[*pose.xyz, *pose.wxyz] for pose in POSES]
        wanted = bytes(memoryview(ovoid.distance_batch(BODIES, COUPLES)).cast("B")) if not numpy else None
        if numpy:
            wanted = ovoid.distance_batch(BODIES, COUPLES).tobytes()
            for poses, order in ((sevens, "xyzw"), (nines, "wxyz")):
                bodies = ovoid.Bodies(SHAPES, numpy.array(poses), order=order)
                self.assertEqual(ovoid.distance_batch(bodies, COUPLES).tobytes(), wanted)
            with self.assertRaisesRegex(ovoid.Error, "order='wxyz'"):
                ovoid.Bodies(SHAPES, numpy.array(sevens))
            matrices = numpy.array([pose.matrix for pose in POSES])
            one = ovoid.Bodies(SHAPES[0], matrices)
            many = ovoid.Bodies([SHAPES[0]] * len(POSES), [ovoid.Pose(matrix) for matrix in matrices])
            self.assertEqual(ovoid.distance_batch(one, COUPLES).tobytes(), ovoid.distance_batch(many, COUPLES).tobytes())
        moved = ovoid.Bodies(SHAPES, [ovoid.Pose()] * len(SHAPES))
        moved.move(POSES)
        self.assertEqual(ovoid.distance_batch(moved, COUPLES).tolist(), ovoid.distance_batch(BODIES, COUPLES).tolist())


class Arrays(unittest.TestCase):
    @needs_numpy
    def test_couples_of_all_kinds(self):
        wanted = ovoid.distance_batch(BODIES, COUPLES).tobytes()
        wide = numpy.zeros((len(COUPLES), 5), numpy.int16)
        wide[:, ::4] = COUPLES
        for couples in (numpy.array(COUPLES), numpy.array(COUPLES, numpy.uint32), numpy.array(COUPLES, numpy.int32),
                        numpy.array(COUPLES, numpy.uint8), wide[:, ::4], numpy.asfortranarray(COUPLES)):
            self.assertEqual(ovoid.distance_batch(BODIES, couples).tobytes(), wanted)

    @needs_numpy
    def test_out(self):
        out, witnesses = ovoid.zeros("verdicts", len(COUPLES)), ovoid.zeros("witnesses", len(COUPLES))
        made = ovoid.distance_batch(BODIES, COUPLES, out=out, witnesses=witnesses)
        self.assertIs(made[0], out)
        self.assertIs(made[1], witnesses)
        self.assertEqual(out.tobytes(), ovoid.distance_batch(BODIES, COUPLES).tobytes())
        self.assertEqual(out.dtype.names, ("status", "stage", "limit", "iterations", "lower", "upper"))
        self.assertEqual(witnesses["point_a"].shape, (len(COUPLES), 3))
        twice = ovoid.zeros("verdicts", 2 * len(COUPLES))
        for bad, kind, sentence in ((out[:-1], ovoid.Error, "1500 items"), (witnesses, TypeError, "another type"),
                                    (twice[::2], TypeError, "contiguous"), (numpy.zeros(1500), TypeError, "another type"),
                                    (out.tobytes(), TypeError, "writable"), (3, TypeError, "writable")):
            with self.assertRaisesRegex(kind, sentence):
                ovoid.distance_batch(BODIES, COUPLES, out=bad)

    def test_refused(self):
        for bad, kind, sentence in (
                (lambda: ovoid.distance_batch(BODIES, [[0, 1], [0, 60]]), ovoid.Error, "couple 1 names body 60 of 60"),
                (lambda: ovoid.distance_batch(BODIES, [[-1, 0]]), ovoid.Error, "couple 0 names body -1 of 60"),
                (lambda: ovoid.distance_batch(BODIES, [[0, 1, 2]]), ovoid.Error, r"\(n, 2\)"),
                (lambda: ovoid.distance_batch(BODIES, [[0.0, 1.5]]), TypeError, "integers"),
                (lambda: ovoid.distance_batch(SHAPES, COUPLES), TypeError, "Bodies"),
                (lambda: ovoid.distance_batch(BODIES, COUPLES, threads=0), ovoid.Error, "threads"),
                (lambda: ovoid.distance_batch(BODIES, COUPLES, cap=-1), ovoid.Error, "negative"),
                (lambda: ovoid.within_batch(BODIES, COUPLES, float("nan")), ovoid.Error, "NaN"),
                (lambda: ovoid.distance_batch(BODIES, COUPLES, progress=3), TypeError, "progress"),
                (lambda: ovoid.Bodies(SHAPES, POSES[1:]), ovoid.Error, "59 poses need as many shapes"),
                (lambda: ovoid.Bodies([1], [ovoid.Pose()]), TypeError, "shape 0"),
                (lambda: ovoid.Bodies(SHAPES[:1], [[[1, 0], [0, 1]]]), ovoid.Error, "pose 0"),
                (lambda: BODIES.move(POSES[1:]), ovoid.Error, "60 bodies")):
            with self.assertRaisesRegex(kind, sentence):
                bad()
        if numpy:
            poses = numpy.array([[0, 0, 0, 1, 0, 0, 0]] * 3, float)
            poses[2, 1] = numpy.nan
            with self.assertRaisesRegex(ovoid.Error, "pose 2: a number is NaN") as caught:
                ovoid.Bodies(SHAPES[0], poses, order="wxyz")
            self.assertEqual(caught.exception.place, 2)
            for couples in (numpy.array(COUPLES, float), numpy.array([[2**63, 0]], numpy.uint64)):
                with self.assertRaises((TypeError, ovoid.Error)):
                    ovoid.distance_batch(BODIES, couples)

    def test_none(self):
        self.assertEqual(len(ovoid.distance_batch(BODIES, [])), 0)
        self.assertEqual(len(ovoid.distance_batch(ovoid.Bodies([], []), [])), 0)


class Long(unittest.TestCase):
    """Batches of some seconds: they let others run, can be followed and can be interrupted."""

    def setUp(self):
        self.rock = [make_rock(300), make_rock(300)]
        self.bodies = ovoid.Bodies(self.rock, [ovoid.Pose(), make_pose(0.1)])
        couples = [[0, 1]] * 200000
        self.couples = numpy.array(couples, numpy.uint32) if numpy else couples

    def test_ctrl_c(self):
        # A shell's background jobs ignore the signal, and so would Python.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        # Seconds of work; the signal is sent once it has begun, however busy the machine is.
        count = 2000000
        couples = memoryview(array("I", [0, 1]) * count).cast("B").cast("I", (count, 2))
        for threads in (1, 2):
            said, begun = [], threading.Event()

            def say(done, total):
                said.append(done)
                begun.set()

            def interrupt():
                begun.wait()
                os.kill(os.getpid(), signal.SIGINT)

            sender = threading.Thread(target=interrupt)
            sender.start()
            with self.assertRaises(KeyboardInterrupt):
                ovoid.depth_batch(self.bodies, couples, threads=threads, progress=say)
            sender.join()
            self.assertLess(said[-1], count)

    def test_progress_and_other_threads(self):
        ticks, said = [], []
        end = threading.Event()

        def tick():
            while not end.wait(0.01):
                ticks.append(1)

        def say(done, total):
            said.append(done)
            self.assertEqual(total, 200000)
            with self.assertRaisesRegex(RuntimeError, "another thread"):
                self.bodies.move([ovoid.Pose()] * 2)
            # However busy the machine is: other threads get to run long before all is done.
            if len(said) >= 3 and len(ticks) > 5:
                raise LookupError("enough")

        thread = threading.Thread(target=tick)
        self.addCleanup(thread.join)
        self.addCleanup(end.set)
        thread.start()
        with self.assertRaisesRegex(LookupError, "enough"):
            ovoid.depth_batch(self.bodies, self.couples, progress=say)
        end.set()
        thread.join()
        self.assertEqual(said, sorted(said))
        self.bodies.move([ovoid.Pose()] * 2)


if __name__ == "__main__":
    common.main()
