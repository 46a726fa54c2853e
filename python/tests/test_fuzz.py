"""Anything may be passed to anything: it is taken, or refused with an exception of a kind that is documented; nothing crashes.

Truth: the process lives, and every answer that comes out holds by its proof. FUZZ_EXAMPLES: how many calls each (24).
"""

import inspect
import math
import os
import pickle
import unittest

import common
import ovoid
from common import hypothesis, needs_hypothesis, numpy

EXAMPLES = int(os.environ.get("FUZZ_EXAMPLES", "24"))
REFUSALS = (TypeError, ValueError, OverflowError, RuntimeError, MemoryError, LookupError, BufferError, AttributeError)
# They read files, or cost what their arguments say.
LEFT_OUT = {"read", "read_obstacles", "read_motion_request", "read_trajectory", "find_problems", "read_paths", "read_path_sources", "show", "compute_matrix", "cover_spheres", "audit_spheres", "audit_parts", "write", "prism", "pyramid", "cylinder", "cone"}

BOX = ovoid.Shape.box((1, 2, 3))
BALL = ovoid.Shape.sphere(1)
FLAT = ovoid.Shape.from_points([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
PLACE = ovoid.Pose.from_rpy((2, 0.5, 0), (1, 2, 3))
COMPOUND = ovoid.Compound([BOX, BALL], [None, PLACE])
MOTION = ovoid.Motion.poses(PLACE, None, 2)
BODIES = ovoid.Bodies([BOX, BALL, FLAT], [None, PLACE, PLACE])
WORLD = ovoid.World()
IDS = [WORLD.add(BOX), WORLD.add(COMPOUND, PLACE)]
ANSWER = ovoid.depth(BOX, BALL)
IMPACT = ovoid.find_impact(BOX, BALL, None, MOTION)
ROBOTS = []
if ovoid.has_robot:
    ROBOT = ovoid.Robot(["a", "b"], [ovoid.Joint("j", "revolute", "a", "b", lower=-1, upper=1)], [("a", BOX), ("b", BALL, PLACE)])
    CELL = ovoid.Cell(ROBOT)
    CELL.add(BALL, PLACE)
    ROBOTS = [ROBOT, CELL, CELL.find_hit([[0], [1]]), ROBOT.joints[0], [ROBOT.joints[0]], ROBOT.elements, "a", [[0.5], [0.7]], [0.5],
              ovoid.zeros("states", 2),
              [("a", (0, 0, 0), 0.5), (1, (0.1, 0, 0), 0.2)]]
PREPARED = ovoid.Prepared(BALL, PLACE)
SWEPT = ovoid.SweptSphere.box((1, 2, 3), PLACE)
SOLID = ovoid.Solid.from_triangles([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
SOLIDS = [SOLID, ovoid.distance(SOLID, BOX, None, PLACE)]
SOLID_BODIES = ovoid.Bodies([SOLID, BOX, COMPOUND], [None, PLACE, PLACE])
IDS.append(WORLD.add(SOLID, PLACE))
OBJECTS = [BOX, BALL, FLAT, PLACE, COMPOUND, MOTION, BODIES, WORLD, ANSWER, IMPACT, ovoid.find_approach(BOX, BALL, None, MOTION),
           ovoid.smooth(BOX, BALL), ovoid.gradient(ovoid.distance(BOX, BALL, None, PLACE)), BOX.outer, ANSWER.proof,
           ovoid.zeros("verdicts", 2), ovoid.zeros("witnesses", 2), ovoid.zeros("proofs", 2), BOX.to_bytes(), BOX.vertices, BOX.faces,
           PLACE.matrix, [(0, 1), (1, 2)], [PLACE] * 3, [BOX] * 3, IDS, "wxyz", "xyzw", "depth", lambda *given: 1 / 0, PREPARED, SWEPT, SOLID_BODIES, *SOLIDS, SOLID.vertices, SOLID.faces,
           *ROBOTS]


def get_calls():
    """Every function of the module and method of its objects, with the names of its arguments."""
    functions = {name: getattr(ovoid, name) for name in ovoid.__all__}
    for one in OBJECTS[:14] + [PREPARED, SWEPT] + SOLIDS + ROBOTS[:3]:
        functions.update({f"{type(one).__name__}.{name}": getattr(one, name) for name in dir(one) if not name.startswith("__")})
        functions[type(one).__name__] = type(one)
    for name, function in sorted(functions.items()):
        if callable(function) and name.split(".")[-1] not in LEFT_OUT and getattr(function, "__module__", "") != "ovoid._enums":
            try:
                names = [key for key in inspect.signature(function).parameters if key not in ("args", "kwargs")]
            except (TypeError, ValueError):
                names = []
            yield name, function, names


def make_values():
    st = hypothesis.strategies
    numbers = st.one_of(st.floats(), st.integers(-3, 7), st.integers(), st.sampled_from([math.nan, math.inf, 1e50, -0.0, 2**64]))
    plain = st.one_of(st.none(), st.booleans(), numbers, st.text(max_size=3), st.binary(max_size=9), st.sampled_from(OBJECTS))
    nested = st.recursive(numbers, lambda inner: st.lists(inner, max_size=4), max_leaves=20)
    triples = st.tuples(*[st.floats(-5, 5)] * 3)
    values = [plain, plain, nested, triples, st.lists(triples, max_size=9)]
    if numpy:
        from hypothesis.extra import numpy as arrays

        kinds = st.one_of(arrays.scalar_dtypes(), st.sampled_from([numpy.dtype(float), ANSWER.proof.dtype]))
        shapes = st.one_of(arrays.array_shapes(min_dims=0, max_dims=4, min_side=0, max_side=7),
                           st.sampled_from([(4, 4), (3, 4, 4), (3, 7), (2, 2), (3,), (4,), (5, 3)]))
        made = st.builds(lambda shape, kind: numpy.zeros(shape, kind), shapes, kinds)
        doubles = arrays.arrays(float, shapes)
        values += [made, doubles, doubles.map(lambda a: a[::-1] if a.ndim else a), doubles.map(numpy.asfortranarray), doubles.map(lambda a: a.T)]
    return st.one_of(values)


@needs_hypothesis
class Anything(unittest.TestCase):
    def call(self, function, given, named):
        try:
            result = function(*given, **named)
        except REFUSALS as error:
            self.assertNotIsInstance(error, SystemError)
            if isinstance(error, ovoid.Error):
                self.assertTrue(str(error))
            return
        except ZeroDivisionError:
            return  # the callback above
        if isinstance(result, (ovoid.Answer, ovoid.Impact, ovoid.Approach)):
            ovoid.verify(result)
        if ROBOTS and isinstance(result, ovoid.RobotPath) and result.status != ovoid.RobotStatus.REFUSED:
            ovoid.verify(result)
        if isinstance(result, ovoid.Solid):
            self.assertEqual(pickle.loads(pickle.dumps(result)).vertices.tolist(), result.vertices.tolist())
        if isinstance(result, ovoid.Shape):
            self.assertEqual(pickle.loads(pickle.dumps(result)).to_bytes(), result.to_bytes())

    def test_calls(self):
        st = hypothesis.strategies
        values = make_values()
        settings = hypothesis.settings(max_examples=EXAMPLES, deadline=None, derandomize=True, database=None,
                                       suppress_health_check=list(hypothesis.HealthCheck))
        for name, function, names in get_calls():
            some = st.dictionaries(st.sampled_from(names), values, max_size=3) if names else st.just({})
            with self.subTest(name=name):
                settings(hypothesis.given(st.lists(values, max_size=4), some)(
                    lambda given, named: self.call(function, given, named)))()

    def test_points(self):
        st = hypothesis.strategies
        coordinate = st.one_of(st.floats(-2, 2), st.integers(-2, 2).map(float), st.floats(allow_nan=False, allow_infinity=False))
        points = st.lists(st.tuples(coordinate, coordinate, coordinate), min_size=1, max_size=12)

        @hypothesis.settings(max_examples=EXAMPLES, deadline=None, derandomize=True, database=None,
                             suppress_health_check=list(hypothesis.HealthCheck))
        @hypothesis.given(points, points, points)
        def run(first, second, places):
            try:
                a, b = ovoid.Shape.from_points(first), ovoid.Shape.from_points(second)
                pose = ovoid.Pose.from_rpy(places[0], (1, 2, 3))
            except ovoid.Error:
                return
            for query in (ovoid.collide, ovoid.distance, ovoid.depth):
                answer = query(a, b, None, pose)
                ovoid.verify(answer)
                ovoid.verify(query(a, b, pose, None, earlier=answer))

        run()

    def test_bytes(self):
        st = hypothesis.strategies
        data = BOX.to_bytes()

        @hypothesis.settings(max_examples=EXAMPLES, deadline=None, derandomize=True, database=None)
        @hypothesis.given(st.integers(0, len(data) - 1), st.integers(1, 255), st.integers(0, len(data)))
        def run(place, change, length):
            broken = bytearray(data)
            broken[place] ^= change
            for given in (bytes(broken), data[:length] if length < len(data) else b""):
                with self.assertRaises(ovoid.Error):
                    ovoid.Shape.from_bytes(given)

        run()


if __name__ == "__main__":
    common.main()
