"""Planning. Truth: the proof of the whole path, verified here again; its ends; the same path from the same seed, and from the tool; what stands still."""

import csv
import os
import signal
import sys
import tempfile
import threading
import unittest
from unittest import mock

import common
import ovoid

SOURCE = os.environ.get("OVOID_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", ".."))
START = os.path.join(SOURCE, "examples", "start")
BUILD = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(ovoid.__file__))))
ENDS = {"shoulder": 0.1, "elbow": 0}, {"shoulder": 1.2, "elbow": -0.3}

try:
    from ovoid import _ompl
except ImportError:
    _ompl = None


def make_cell():
    cell = ovoid.Cell(ovoid.Robot.read(os.path.join(START, "arm.urdf"), os.path.join(START, "arm.srdf")))
    cell.read(os.path.join(START, "cell.json"))
    return cell


@unittest.skipUnless(_ompl and ovoid.has_robot and ovoid.has_io, "built without OMPL or readers of robots")
class Plans(unittest.TestCase):
    def test_path(self):
        cell = make_cell()
        self.assertEqual(cell.find_hit(ENDS, margin=0.005).status, "hit")  # the straight way
        plan = cell.plan(*ENDS, margin=0.005)
        ovoid.verify(plan.path)
        self.assertEqual((plan.path.status, plan.path.margin, plan.seed, plan.planner), ("free", 0.005, 1, "rrtconnect"))
        states = plan.states.tolist()
        self.assertEqual((states[0], states[-1]), ([0.1, 0], [1.2, -0.3]))
        self.assertEqual(plan.path.states.tolist(), states)
        self.assertLess(plan.length, plan.raw_length)
        self.assertGreater(plan.motions, 0)
        self.assertEqual(cell.plan(*ENDS, margin=0.005).states.tolist(), states)
        self.assertNotEqual(cell.plan(*ENDS, margin=0.005, seed=7).states.tolist(), states)
        raw = cell.plan(*ENDS, margin=0.005, raw=True)
        self.assertEqual(raw.length, plan.raw_length)
        ovoid.verify(cell.plan(*ENDS, planner="biest").path)

    @unittest.skipUnless(os.path.exists(os.path.join(BUILD, "ovoid-plan")), "ovoid-plan is not built")
    def test_as_the_tool(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "path.csv")
            words = ["arm.urdf", "--srdf", "arm.srdf", "--scene", "cell.json", "--request", "request.yaml", "--margin", "0.005", "--seed", "3", "--limit-slack", "0"]
            common.run_tool([os.path.join(BUILD, "ovoid"), "robot", "plan", *words, "-o", path], check=True, capture_output=True, cwd=START)
            with open(path, encoding="utf-8") as file:
                rows = list(csv.reader(file))
        request = ovoid.read_motion_request(os.path.join(START, "request.yaml"))
        plan = make_cell().plan(request.start, request.goals, moving=request.group, margin=0.005, seed=3)
        self.assertEqual(rows[0], ["shoulder", "elbow"])
        self.assertEqual(plan.states.tolist(), [[float(number) for number in row] for row in rows[1:]])

    def test_goals(self):
        cell = make_cell()
        with self.assertWarnsRegex(UserWarning, "goal 0: not free: fore, post: hit"):
            plan = cell.plan(ENDS[0], [{"shoulder": 0.5}, ENDS[1]])
        self.assertEqual(plan.states.tolist()[-1], [1.2, -0.3])
        with self.assertRaisesRegex(ovoid.Error, "the goal: not free: fore, post: hit"):
            cell.plan(ENDS[0], (0.5, 0))
        with self.assertRaisesRegex(ovoid.Error, "the start: not free: fore, post: hit"):
            cell.plan({"shoulder": 0.5}, ENDS[1])
        with self.assertWarns(UserWarning), self.assertRaisesRegex(ovoid.Error, "no goal is free"):
            cell.plan(ENDS[0], [(0.5, 0), (0.5, 0.01)])
        # What a goal does not name stays where it starts.
        plan = cell.plan({"shoulder": -1, "elbow": 0.3}, {"shoulder": -2}, moving=["shoulder"])
        self.assertEqual([state[1] for state in plan.states.tolist()], [0.3] * len(plan.states))

    def test_trouble(self):
        cell = make_cell()
        for how, sentence in (({"planner": "prm"}, "no planner 'prm': rrtconnect, biest"), ({"seed": 0}, "seed is"), ({"seconds": 0}, "seconds a number"),
                              ({"seconds": float("inf")}, "seconds a number"), ({"moving": "hand"}, "no group 'hand'"), ({"moving": ["knee"]}, "knee"),
                              ({"moving": ["elbow"]}, "the planner does not move it"), ({"margin": -1}, "margin")):
            with self.assertRaisesRegex(ovoid.Error, sentence):
                cell.plan(*ENDS, **how)
        for start, goal in (({"knee": 0}, ENDS[1]), (ENDS[0], []), (ENDS[0], "up"), ((9, 9), ENDS[1]), ((0,), ENDS[1])):
            with self.assertRaises(ovoid.Error):
                cell.plan(start, goal)
        for moving in ([], ()):
            with self.assertRaisesRegex(ovoid.Error, "moving=.* has no joint"):
                cell.plan(*ENDS, moving=moving)
        self.assertIsNone(cell.plan((-0.5, 0), (2.6, 0.5), margin=0.16, seconds=0.05))
        cell.add(ovoid.Shape.sphere(0.1), (9, 9, 9))  # no query is left open

    def test_ends(self):
        """What is said of an end that is no state: which one, what it has, what is wanted."""
        cell, (start, goal) = make_cell(), ENDS
        for ends, sentence in ((((0,), goal), "the start has 1 number, the robot 2 variables"), (((0, 0, 0), goal), "the start has 3 numbers, the robot 2"),
                               (((), goal), "the start has 0 numbers"), ((start, (1.2,)), "the goal has 1 number, the robot 2 variables"),
                               ((start, [(1.2, 0), (1,)]), "goal 1 has 1 number"), ((start, {}), "the goal names no joint"), ((start, [goal, {}]), "goal 1 names no joint")):
            with self.assertRaisesRegex(ovoid.Error, sentence):
                cell.plan(*ends)
        for state in (b"x", None, 5, [0, None], [(0, 0)], [0, (1, 2)]):
            with self.assertRaisesRegex(TypeError, "the start: a state is numbers, one for each variable of the robot, a name or a dict by names, not"):
                cell.plan(state, goal)
        for state, what in ((b"x", "the goal"), (None, "the goal"), (5, "the goal"), ([0, None], "the goal"), ([(1.2, 0), None], "goal 1"), ([b"x", b"y"], "goal 0")):
            with self.assertRaisesRegex(TypeError, f"{what}: a state is numbers"):
                cell.plan(start, state)

    def test_refused(self):
        """A number outside its limits is told as the tool tells it, a joint that follows with its own."""
        cell, (start, goal) = make_cell(), ENDS
        with self.assertRaisesRegex(ovoid.Error, r"^the start: shoulder: 9 is outside its limits, -3 \.\. 3$"):
            cell.plan((9, 0), goal)
        with self.assertRaisesRegex(ovoid.Error, r"^the goal: elbow: -2.75 is outside its limits, -2.6 \.\. 2.6$"):
            cell.plan(start, {"elbow": -2.75})
        joints = [ovoid.Joint("j", "revolute", "a", "b", lower=-3, upper=3), ovoid.Joint("k", "revolute", "b", "c", lower=-1, upper=1, mimic="l", multiplier=2, offset=0.5),
                  ovoid.Joint("l", "revolute", "c", "d", lower=-9, upper=9, mimic="j", multiplier=-1)]
        cell = ovoid.Cell(ovoid.Robot(["a", "b", "c", "d"], joints, [("d", ovoid.Shape.sphere(0.1))]))
        cell.add(ovoid.Shape.sphere(0.1), (9, 9, 9))
        with self.assertRaisesRegex(ovoid.Error, r"^the goal: j: k, which follows it, is -1.5, outside its limits, -1 \.\. 1$"):
            cell.plan([0], [1])

    def test_interrupt(self):
        """A signal's handler that raises ends the search, and the cell can be changed again."""
        def end(*_):
            raise KeyboardInterrupt
        before = signal.signal(signal.SIGALRM, end)
        cell = make_cell()
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.1)
            with self.assertRaises(KeyboardInterrupt):
                cell.plan((-0.5, 0), (2.6, 0.5), margin=0.16, seconds=60)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        cell.add(ovoid.Shape.sphere(0.1), (9, 9, 9))

    def test_threads(self):
        """Searches at once find what each finds alone."""
        alone = [make_cell().plan(*ENDS, margin=0.005, seed=seed).states.tolist() for seed in (1, 2, 3)]
        found = {}

        def run(seed):
            found[seed] = make_cell().plan(*ENDS, margin=0.005, seed=seed).states.tolist()
        threads = [threading.Thread(target=run, args=(seed,)) for seed in (1, 2, 3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual([found[seed] for seed in (1, 2, 3)], alone)


@unittest.skipUnless(ovoid.has_robot and ovoid.has_io, "built without readers of robots")
class Without(unittest.TestCase):
    def test_without_planners(self):
        with mock.patch.dict(sys.modules, {"ovoid._ompl": None}), mock.patch.object(ovoid, "_ompl", None, create=True):
            del ovoid._ompl
            with self.assertRaisesRegex(ovoid.Error, "this build of ovoid has no planners: .*libompl-dev"):
                make_cell().plan(*ENDS)


if __name__ == "__main__":
    common.main()
