"""Paths of robots: clearances, comparisons with models, files of proofs, and calls that Ctrl-C ends.

Truth: closed forms of an arm of two bars; the answers of the single queries; proofs; files written here as docs/robot-path.md has them.
"""

import array
import json
import math
import os
import signal
import tempfile
import time
import unittest

import common
import ovoid
from common import needs_numpy, numpy

BAR = ovoid.Shape.capsule(0.1, 0.5)
ALONG = ovoid.Pose.from_rpy((0.5, 0, 0), (0, math.pi / 2, 0))
BALL = ovoid.Shape.sphere(0.2)
Agreement = ovoid.Agreement


def at(x, y=0, z=0):
    return ovoid.Pose.from_rpy((x, y, z), (0, 0, 0))


def make_cell(robot=None):
    """Two bars of length 1 in the plane z = 0 on joints about z, and a ball on the x axis."""
    if robot is None:
        joints = [ovoid.Joint("shoulder", "revolute", "base", "upper", axis=(0, 0, 1), lower=-3, upper=3),
                  ovoid.Joint("elbow", "revolute", "upper", "lower", at(1), (0, 0, 1), -3, 3)]
        elements = [("upper", BAR, ALONG), ovoid.Element("lower", BAR, ALONG, "bar")]
        robot = ovoid.Robot(["base", "upper", "lower"], joints, elements, [("upper", "lower")])
    cell = ovoid.Cell(robot)
    cell.add(BALL, at(1.5))
    return cell


def rows(records):
    """Records as dicts, of NumPy's arrays too."""
    if isinstance(records, ovoid.Array):
        return records.tolist()
    return [{name: x.tolist() if hasattr(x, "tolist") else x for name, x in zip(records.dtype.names, record)} for record in records.tolist()]


@unittest.skipUnless(ovoid.has_robot, "built without libovoid_robot")
class Edges(unittest.TestCase):
    """Edges in batches. Truth: each edge alone, with its proof; refusals by name."""

    def setUp(self):
        self.cell = make_cell()
        self.begins = [[2 * math.sin(1.7 * i), 2 * math.sin(2.3 * i)] for i in range(300)]
        self.ends = [[(0.8 - 0.4 * (i % 4)) * begin[0], begin[1] - 0.3 * (i % 3)] for i, begin in enumerate(self.begins)]
        self.begins[7][0] = 4.0

    def check(self, **how):
        found, times = self.cell.find_hit_batch(self.begins, self.ends, **how)
        times = memoryview(times).tolist()
        counts = [0] * 4
        for begin, end, row, (free_until, hit_at) in zip(self.begins, self.ends, rows(found), times):
            alone = self.cell.find_hit([begin, end])
            self.assertEqual(row["status"], alone.status)
            counts[row["status"]] += 1
            if alone.status == ovoid.RobotStatus.FREE:
                self.assertEqual((free_until, hit_at), (1, math.inf))
            elif alone.status == ovoid.RobotStatus.HIT:
                ovoid.verify(alone)
                self.assertTrue(hit_at >= alone.free_until and row["upper"] <= 0 and row["link_a"] in (1, 2))
        self.assertTrue(counts[ovoid.RobotStatus.FREE] > 100 and counts[ovoid.RobotStatus.HIT] > 30, counts)
        self.assertEqual((counts[ovoid.RobotStatus.REFUSED], rows(found)[7]["variable"]), (1, 0))
        return found, times

    def test_verdicts(self):
        found, times = self.check(any_hit=True)
        other, again = self.cell.find_hit_batch(self.begins, self.ends, any_hit=True, threads=3)
        self.assertEqual(rows(found), rows(other))
        self.assertEqual(times, memoryview(again).tolist())
        is_named = [name is not None for name in self.cell.pair_names(found)]
        self.assertEqual(is_named, [row["status"] == ovoid.RobotStatus.HIT for row in rows(found)])

    def test_first_hits(self):
        found, times = self.check()
        for begin, end, (free_until, hit_at) in list(zip(self.begins, self.ends, times))[:50]:
            alone = self.cell.find_hit([begin, end])
            self.assertAlmostEqual(free_until, alone.free_until, delta=1e-5)

    def test_refused(self):
        seen = []
        self.cell.find_hit_batch(self.begins, self.ends, any_hit=True, progress=lambda *at: seen.append(at))
        self.assertEqual(seen[-1], (300, 300))
        for begins, how in ((self.begins[1:], {}), ("x", {}), ([[1.0]] * 300, {}), (self.begins, {"threads": 0}),
                            (self.begins, {"margin": math.nan}), (self.begins, {"tolerance": -1}), (self.begins, {"progress": 3})):
            with self.assertRaises((TypeError, ovoid.Error)):
                self.cell.find_hit_batch(begins, self.ends, **how)
        self.assertEqual([len(x) for x in self.cell.find_hit_batch([], [])], [0, 0])


@unittest.skipUnless(ovoid.has_robot, "built without libovoid_robot")
class Clearances(unittest.TestCase):
    def test_closed_form(self):
        """The arm straight, from an angle to a smaller one: the ball is nearest at the end, r sin(angle) less both radii."""
        cell = make_cell()
        found = cell.clearance([[1.2, 0], [0.4, 0]], tolerance=1e-4)
        least = 1.5 * math.sin(0.4) - 0.3
        self.assertTrue(found.lower <= least <= found.upper + 1e-12 and found.upper - found.lower < 1.1e-4, found)
        self.assertEqual((found.status, found.refused, found.code), (ovoid.RobotStatus.FREE, None, None))
        self.assertAlmostEqual(found.at, 1, delta=1e-3)
        self.assertEqual((found.a.link, found.b.body), (2, list(cell.bodies)[0]))
        self.assertGreater(found.looked_at, 2)
        self.assertEqual(cell.clearance([[1.2, 0], [0.4, 0]], margin=0.3).status, ovoid.RobotStatus.HIT)
        # The least over both segments, through the ball: minus the sum of the radii.
        through = cell.clearance([[1.2, 0], [-0.4, 0], [-1, 0]])
        self.assertTrue(through.lower <= -0.3 <= through.upper + 1e-3)
        self.assertAlmostEqual(through.at, 0.75, delta=0.05)
        far = cell.clearance([[1.2, 0]], without_obstacles=True, without_self=True)
        self.assertEqual((far.lower, far.upper, far.a, far.at), (math.inf, math.inf, None, None))
        self.assertEqual((far.status, far.code, through.code), ("undecided", ovoid.Code.EMPTY, None))
        few = cell.clearance([[1.2, 0], [0.4, 0]], most_states=5)
        self.assertTrue(few.looked_at <= 5 and few.lower <= least <= few.upper + 1e-12)

    def test_refused(self):
        cell = make_cell()
        found = cell.clearance([[1, 0], [1, 1], [4, 0]])
        self.assertEqual((found.status, found.refused, found.code, found.variable), (ovoid.RobotStatus.REFUSED, 1, ovoid.Code.RANGE, 0))
        self.assertEqual((found.a, found.at), (None, None))
        for states, options in (([], {}), ([[1]], {}), ("x", {}), ([[1, 0]], {"tolerance": -1}), ([[1, 0]], {"margin": math.nan}),
                                ([[1, 0]], {"most_states": 2**32}), ([[math.nan, 0], [1, 0]], {})):
            try:
                found = cell.clearance(states, **options)
            except (TypeError, ovoid.Error):
                continue
            self.assertEqual(found.status, ovoid.RobotStatus.REFUSED, (states, options))

    @needs_numpy
    def test_arrays(self):
        cell = make_cell()
        states = numpy.array([[1.2, 0], [0.4, 0.5], [0.4, 1]])
        expected = cell.clearance(states.tolist())
        for given in (numpy.asfortranarray(states), numpy.repeat(states, 2, 0)[::2], states[::-1][::-1]):
            cell.reset()
            self.assertEqual(cell.clearance(given)[:3], expected[:3])
        for bad in (states.astype(complex), states.astype(">f8"), states.astype("f2"), states[:, :1], states[0]):
            with self.assertRaises((TypeError, ovoid.Error)):
                cell.clearance(bad)


@unittest.skipUnless(ovoid.has_robot, "built without libovoid_robot")
class Models(unittest.TestCase):
    def setUp(self):
        self.cell = make_cell()
        robot = self.cell.robot
        # A sphere in the middle of each bar misses its ends; one at the elbow is three times as thick as the bar.
        self.spheres = [("upper", (0.5, 0, 0), 0.1), (2, (0.5, 0, 0), 0.1), ("upper", (1, 0, 0), 0.4)]
        self.model = make_cell(robot.with_spheres(self.spheres))

    def test_robot(self):
        made = self.model.robot
        self.assertEqual((made.links, [v.name for v in made.variables]), (self.cell.robot.links, ["shoulder", "elbow"]))
        self.assertEqual([(one.link, one.pose.xyz, one.shape.radius) for one in made.elements],
                         [("upper", (0.5, 0, 0), 0.1), ("lower", (0.5, 0, 0), 0.1), ("upper", (1, 0, 0), 0.4)])
        self.assertEqual(made.disabled, self.cell.robot.disabled)
        # The shapes outlive the robot.
        shape = self.cell.robot.with_spheres(self.spheres).elements[2].shape
        self.assertEqual((shape.radius, ovoid.distance(shape, BALL, None, at(1)).is_within(0.41)), (0.4, True))
        self.assertEqual(self.cell.robot.with_spheres(()).elements, ())
        robot = self.cell.robot
        for bad, place in (([("upper", (0, 0, 0), 1), ("upper", (0, 0, 0), -1)], 1), ([("upper", (0, math.nan, 0), 1)], 0), ([("no", (0, 0, 0), 1)], -1),
                           ([(7, (0, 0, 0), 1)], -1)):
            with self.assertRaises(ovoid.Error) as raised:
                robot.with_spheres(bad)
            self.assertEqual(raised.exception.place, place)
        for bad in (3, [3], [("upper", (0, 0, 0))], [("upper", None, 1)], [["upper", (0, 0, 0), 1]], [("upper", (0, 0), 1)]):
            with self.assertRaises((TypeError, ovoid.Error)):
                robot.with_spheres(bad)

    def test_comparison(self):
        states = [(math.remainder(0.37 * i, 5.8), math.remainder(0.61 * i, 5.8)) for i in range(700)]
        seen = []
        found = ovoid.compare_states(self.cell, self.model, states, progress=lambda *at: seen.append(at))
        wanted = []
        for q in states:
            robot, model = (cell.collide(q).status for cell in (self.cell, self.model))
            hit = ovoid.RobotStatus.HIT
            wanted.append(Agreement.BOTH_HIT if robot == model == hit else Agreement.MISSED if robot == hit
                          else Agreement.INVENTED if model == hit else Agreement.BOTH_FREE)
        self.assertEqual(found.agreements.tolist(), wanted)
        self.assertEqual(found.counts, {one: wanted.count(one) for one in Agreement})
        self.assertTrue(all(found.counts[one] for one in list(Agreement)[1:]), found.counts)
        self.assertEqual(seen[-1], (700, 700))
        self.assertEqual(str(Agreement.BOTH_HIT), "both hit")
        # The deepest of those missed, by the nearest pair of each.
        depths = {i: rows(self.cell.nearest(states[i])[0])[0]["upper"] for i, one in enumerate(wanted) if one == Agreement.MISSED}
        self.assertEqual(found.deepest_state, min(depths, key=depths.get))
        self.assertAlmostEqual(rows(found.deepest)[0]["upper"], min(depths.values()), delta=1e-9)
        same = ovoid.compare_states(self.cell, self.cell, states[:64])
        self.assertEqual((same.deepest, same.deepest_state, same.counts[Agreement.MISSED]), (None, None, 0))
        self.assertEqual(ovoid.compare_states(self.cell, self.model, [(0, 0), (9, 0)]).agreements.tolist(), [Agreement.BOTH_HIT, Agreement.OPEN])
        self.assertEqual(len(ovoid.compare_states(self.cell, self.model, []).agreements), 0)

    def test_refused(self):
        other = ovoid.Cell(ovoid.Robot(["a"], []))
        with self.assertRaises(ovoid.Error):
            ovoid.compare_states(self.cell, other, [(0, 0)])
        for given in ((self.cell, self.cell.robot, [(0, 0)]), (3, self.cell, []), (self.cell, self.model, [(0,)]), (self.cell, self.model, 3)):
            with self.assertRaises((TypeError, ovoid.Error)):
                ovoid.compare_states(*given)
        with self.assertRaises(TypeError):
            ovoid.compare_states(self.cell, self.model, [(0, 0)], progress=3)
        with self.assertRaises(ZeroDivisionError):
            ovoid.compare_states(self.cell, self.model, [(0, 0)], progress=lambda *at: 1 / 0)
        self.cell.add(BALL, at(9))  # nothing is at work any more


def write_proofs(path, paths, **changes):
    """Writes RobotPaths of one cell as `ovoid robot path --proofs` does."""
    cell = paths[0].cell
    links = cell.robot.links

    def name(side):
        if side.link is None:
            return {"obstacle": "ball", "part": 0}
        element = cell.robot.elements[side.element]
        return {"link": links[side.link], "element": 0, **({"name": element.name} if element.name else {})}

    pairs = [[name(side) for side in cell.pair(i)] for i in range(cell.pair_count)]
    head = {"path_proofs": 2, "robot": "arm.urdf", "srdf": None, "scene": "cell.yaml", "packages": ["a=b"], "scales": [], "paddings": [],
            "parts": False, "hull": False, "visual": False, "fixed_base": True, "cylinder_tolerance": 0, "margin": 0, "limit_slack": 0,
            "paths": len(paths), "digest": "00000000000000ff", "variables": [v.name for v in cell.robot.variables], "pairs": pairs}
    head.update({key: value for key, value in changes.items() if key in head})
    with open(path, "w", encoding="ascii") as file:
        file.write(json.dumps(head, separators=(",", ":")) + "\n")
        for number, one in enumerate(paths):
            steps = rows(one.steps)
            line = {"path": number, "status": str(one.status), "states": len(one.states), "margin": 0, "free_until": one.free_until}
            if one.status == ovoid.RobotStatus.HIT:
                pair = [list(map(name, cell.pair(i))) for i in range(cell.pair_count)].index([name(one.hit.a), name(one.hit.b)])
                line.update({"hit_at": one.hit_at, "segment": int(one.free_until), "pair": pair, "a": name(one.hit.a), "b": name(one.hit.b),
                             "lower": one.hit.lower, "upper": one.hit.upper})
            line.update({"looked_at": one.looked_at, "steps": len(steps), "q": one.states.tolist()})
            line["free_until"] = changes.get("free_until", one.free_until)
            file.write(json.dumps(line, separators=(",", ":")) + "\n")
            for step in steps:
                kind = ("outer", "middle", "ends")[step["kind"] - 1]
                made = {"step": kind, "begin": step["begin"], "end": step["end"]}
                if kind != "outer":
                    made["normal"] = list(step["normal"])
                made["pairs"] = [step["pair"] + i for i in range(8) if step["mask"] >> i & 1]
                file.write(json.dumps(made, separators=(",", ":")) + "\n")


@unittest.skipUnless(ovoid.has_robot and ovoid.has_io, "built without readers of robots")
class Proofs(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = os.path.join(self.folder.name, "proofs.jsonl")
        self.cell = make_cell()
        self.paths = [self.cell.find_hit(states) for states in ([[1.2, 0], [0.5, 0.4], [0.5, 2]], [[1, 0], [-1, 0]], [[2, 1]])]

    def test_claims(self):
        write_proofs(self.path, self.paths)
        claims = self.cell.read_paths(self.path)
        for claim, path in zip(claims, self.paths):
            self.assertEqual((claim.status, claim.free_until, claim.hit_at, claim.looked_at), (path.status, path.free_until, path.hit_at, path.looked_at))
            self.assertEqual((claim.states.tolist(), rows(claim.steps)), (path.states.tolist(), rows(path.steps)))
            ovoid.verify(claim)
        self.assertEqual(claims[1].hit, self.paths[1].hit)
        self.assertEqual(len(claims), 3)
        # The same file is no proof of another scene, and what is said beyond it does not hold.
        other = make_cell(self.cell.robot)
        other.move(list(other.bodies)[0], at(0.9, 0.9))
        self.assertFalse(ovoid.is_proven(other.read_paths(self.path)[0]))
        write_proofs(self.path, self.paths[:1], free_until=2.5)
        with self.assertRaises(ovoid.Error):
            ovoid.verify(self.cell.read_paths(self.path)[0])

    def test_source(self):
        write_proofs(self.path, self.paths)
        (source,) = ovoid.read_path_sources(self.path)
        self.assertEqual((source["robot"], source["srdf"], source["scene"], source["packages"], source["digest"], source["path_count"]),
                         ("arm.urdf", None, "cell.yaml", ("a=b",), 255, 3))
        self.assertEqual(source["attached"], ())
        self.assertEqual((source["variables"], source["fixed_base"], source["parts"], source["margin"]), (("shoulder", "elbow"), True, False, 0))

    def test_refused(self):
        for changes in ({"variables": ["shoulder", "wrist"]}, {"variables": ["shoulder"]}, {"pairs": []}):
            write_proofs(self.path, self.paths[2:], **changes)
            with self.assertRaises(ovoid.Error):
                self.cell.read_paths(self.path)
        write_proofs(self.path, self.paths)
        more = make_cell(self.cell.robot)
        more.add(BALL, at(9))
        renamed = [ovoid.Element(one.link, one.shape, one.pose, "other") for one in self.cell.robot.elements]
        named = make_cell(ovoid.Robot(self.cell.robot.links, self.cell.robot.joints, renamed, [("upper", "lower")]))
        for cell in (more, named):
            with self.assertRaisesRegex(ovoid.Error, "other pairs of bodies") as raised:
                cell.read_paths(self.path)
            self.assertEqual((raised.exception.code, raised.exception.place), (ovoid.Code.PROOF, 2))
        with open(self.path, encoding="ascii") as file:
            text = file.read()
        for bad in (text[:-9], text.replace('"ends"', '"end"'), "{}\n", text.replace("0.5", "NaN")):
            with open(self.path, "w", encoding="ascii") as file:
                file.write(bad)
            for read in (self.cell.read_paths, ovoid.read_path_sources):
                with self.assertRaises(ovoid.Error):
                    read(self.path)
        for call in (lambda: self.cell.read_paths(3), lambda: self.cell.read_paths(self.path + "x"), lambda: ovoid.read_path_sources(None)):
            with self.assertRaises((TypeError, ovoid.Error)):
                call()


class Enough(Exception):
    """What the signal's handler raises."""


@unittest.skipUnless(ovoid.has_robot and hasattr(signal, "setitimer"), "built without libovoid_robot")
class Interrupted(unittest.TestCase):
    """Calls that would take minutes of the processor end some hundredths of a second after a signal; the time is the processor's."""

    def check_ended(self, call):
        def stop(*_):
            raise Enough

        before = signal.signal(signal.SIGVTALRM, stop)
        begun = time.process_time()
        try:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0.05)
            with self.assertRaises(Enough):
                call()
        finally:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
            signal.signal(signal.SIGVTALRM, before)
        self.assertLess(time.process_time() - begun, 8)

    def test_paths(self):
        cell = make_cell()
        cell.remove(list(cell.bodies)[0])
        for i in range(40):
            cell.add(BALL, at(0.02 * i, 0.4 * math.cos(i), 0.4))
        count = 1 << 18
        states = memoryview(array.array("d", [0.3 * (i * i % 19) - 2.7 for i in range(2 * count)])).cast("B").cast("d", [count, 2])
        self.check_ended(lambda: cell.find_hit(states, most_states=2**32 - 1))
        self.check_ended(lambda: cell.clearance(states, tolerance=1e-9, most_states=2**32 - 1))
        self.check_ended(lambda: cell.nearest_batch(states))
        self.check_ended(lambda: ovoid.compare_states(cell, cell, memoryview(array.array("d", bytes(1 << 26))).cast("B").cast("d", [1 << 22, 2])))
        cell.add(BALL, at(9))  # nothing is at work any more
        self.assertEqual(cell.find_hit([[1.2, 0], [0.5, 0]]).status, ovoid.RobotStatus.FREE)

    def test_robots(self):
        robot = make_cell().robot
        robot = ovoid.Robot(robot.links, robot.joints, robot.elements)
        self.check_ended(lambda: robot.compute_matrix(samples=10**12))
        spheres = [(0.1 * i, 0.02 * math.sin(i), 0.02 * math.cos(i), 0.11) for i in range(-2, 14)]
        self.check_ended(lambda: robot.audit_spheres("upper", spheres, tolerance=1e-300, depth_cells=1 << 20, volume_cells=1 << 20))
        self.check_ended(lambda: robot.cover_spheres("upper", 40, rounds=10**9))
        self.assertEqual(len(robot.compute_matrix(samples=10, budget=10)), 1)


if __name__ == "__main__":
    common.main()
