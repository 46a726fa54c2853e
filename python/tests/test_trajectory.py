"""Trajectories of MoveIt and ROS. Truth: the tool's answer to the same file; what a point does not name is where the file has it before."""

import json
import os
import tempfile
import unittest
import warnings

import common
import ovoid

SOURCE = os.environ.get("OVOID_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", ".."))
START = os.path.join(SOURCE, "examples", "start")
ARM = os.path.join(START, "arm.urdf")
TOOL = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(ovoid.__file__)))), "ovoid")


def make_points(names, *rows, times=None):
    """A JointTrajectory."""
    points = [{"positions": row} for row in rows]
    for point, time in zip(points, times or ()):
        point["time_from_start"] = time
    return {"joint_names": names, "points": points}


def display(start, *trajectories):
    """A DisplayTrajectory."""
    return {"trajectory_start": {"joint_state": {"name": list(start), "position": list(start.values())}},
            "trajectory": [{"joint_trajectory": one} for one in trajectories]}


def find_hit(points, urdf=ARM):
    cell = ovoid.Cell(ovoid.Robot.read(urdf, os.path.join(START, "arm.srdf")))
    cell.read(os.path.join(START, "cell.json"))
    return cell.find_hit(points)


@unittest.skipUnless(ovoid.has_robot and ovoid.has_io, "built without readers of robots")
class Trajectories(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = os.path.join(self.folder.name, "trajectory.json")

    def read(self, message):
        with open(self.path, "w", encoding="utf-8") as file:
            json.dump(message, file)
        return ovoid.read_trajectory(self.path)

    def ask_tool(self, urdf=ARM):
        words = ["robot", "path", urdf, "--srdf", "arm.srdf", "--scene", "cell.json", "--states", self.path, "--limit-slack", "0", "--json"]
        return common.run_tool([TOOL, *words], check=False, capture_output=True, text=True, cwd=START)

    def test_whole_points(self):
        read = self.read(display({"elbow": 1, "shoulder": 0.2}, make_points(["shoulder"], [0.2], [0.3]), make_points(["elbow"], [1.5])))
        self.assertEqual(read.start, {"elbow": 1, "shoulder": 0.2})
        self.assertEqual(read.points, [{"elbow": 1, "shoulder": 0.2}, {"elbow": 1, "shoulder": 0.3}, {"elbow": 1.5, "shoulder": 0.3}])
        self.assertEqual(self.read(make_points(["elbow"], [1], [2])).points, [{"elbow": 1}, {"elbow": 2}])

    @unittest.skipUnless(os.path.exists(TOOL), "the tool is not built")
    def test_as_the_tool(self):
        seen = set()
        for message in (display({"elbow": 2.4, "shoulder": -1}, make_points(["shoulder"], [-1], [1.2])),  # folded past the post
                        display({"elbow": 0, "shoulder": -1}, make_points(["shoulder"], [-1], [1.2])),
                        display({"shoulder": 0.5}, make_points(["elbow"], [0], [0.3])),  # in the post from the start
                        display({}, make_points(["shoulder"], [-1], [-0.5]), make_points(["elbow"], [0.5], [1])),
                        display({}, make_points(["shoulder"], [0], [0.1]), make_points(["elbow"], [0.1], [2])),
                        make_points(["elbow"], [0.1], [1]), make_points(["shoulder"], [0.2], [1]), display({"elbow": 9}, make_points(["shoulder"], [0], [1]))):
            with self.subTest(message):
                path = find_hit(self.read(message).points)
                tool = self.ask_tool()
                answer = json.loads(tool.stdout.splitlines()[-1])
                self.assertEqual(str(path.status), answer["status"], tool)
                if answer["status"] in ("free", "hit"):
                    self.assertEqual(path.free_until, answer["free_until"], tool)
                seen.add(str(path.status))
        self.assertEqual(seen, {"free", "hit", "refused"})

    @unittest.skipUnless(os.path.exists(TOOL), "the tool is not built")
    def test_default_as_the_tool(self):
        """Where 0 is outside the limits: joints that nothing names."""
        with open(ARM, encoding="utf-8") as file:
            text = file.read().replace('lower="-2.6"', 'lower="0.5"')
        urdf = os.path.join(self.folder.name, "bent.urdf")
        with open(urdf, "w", encoding="utf-8") as file:
            file.write(text)
        self.assertEqual(ovoid.Robot.read(urdf).default_state(), [0, 1.55])
        path = find_hit(self.read(make_points(["shoulder"], [-2], [2])).points, urdf)
        answer = json.loads(self.ask_tool(urdf).stdout)
        self.assertEqual((str(path.status), path.free_until), (answer["status"], answer["free_until"]))
        self.assertIn("elbow 1.55", self.ask_tool(urdf).stderr)
        half = ovoid.Joint("j", "prismatic", "a", "b", lower=1, upper=float("inf"))
        self.assertEqual(ovoid.Robot(["a", "b"], [half], [("b", ovoid.Shape.sphere(1))]).default_state(), [1])

    def test_far_start(self):
        with self.assertWarnsRegex(UserWarning, r"shoulder is 0.5 in trajectory_start, 1 in the first point: the way between is not checked"):
            self.read(display({"shoulder": 0.5}, make_points(["shoulder"], [1])))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.read(display({"shoulder": 0.995}, make_points(["shoulder"], [1])))
            self.assertEqual(len(self.read(display({"shoulder": 1}, make_points(["shoulder"], [1], [2]))).points), 2)
            with self.assertRaises(UserWarning):
                self.read(display({"shoulder": 0.5}, make_points(["shoulder"], [1])))

    def test_times(self):
        self.assertEqual(self.read(make_points(["elbow"], [1], [2], times=[0, 0.5])).times, [0, 0.5])
        self.assertIsNone(self.read(make_points(["elbow"], [1], [2], times=[0, 0])).times)
        for times, sentence in (([0, 1, 0.5], "point 2: its time, 0.5 s, is not after that of the point before, 1 s"),
                                ([0, 1, 1], "point 2: its time, 1 s, is not after"), ([1, 0, 2], "point 1: its time, 0 s")):
            with self.assertRaisesRegex(ovoid.Error, sentence) as trouble:
                self.read(make_points(["elbow"], [1], [2], [2.1], times=times))
            self.assertEqual((trouble.exception.code, trouble.exception.place), (ovoid.Code.FORMAT, 1))
            self.assertIn(f"{self.path}:1: ", str(trouble.exception))
            if os.path.exists(TOOL):
                tool = self.ask_tool()
                self.assertEqual(tool.returncode, 3, tool)
                self.assertIn(sentence, tool.stderr)


if __name__ == "__main__":
    common.main()
