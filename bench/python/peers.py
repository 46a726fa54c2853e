"""ovoid beside what Debian's Python has of its like: ODE (python3-pyode), and through DART (python3-dartpy) FCL, Bullet and ODE.

Two boxes, the second at many random poses: do they touch, and where FCL tells it, how far apart are they? Each library gets the pose as
its Python takes it and answers one pair a call; ovoid also all of them in one call. Prints nanoseconds a pose, the least of some rounds in
turns, and on how many poses the answers differ, left out those whose distance is below a millionth of the boxes' size.
"""

import random
import sys
import time

import ovoid

try:
    import numpy
except ImportError:
    sys.exit("peers.py needs python3-numpy")
try:
    import ode
except ImportError:
    ode = None
try:
    import dartpy
except ImportError:
    dartpy = None

HALF_A, HALF_B = (1, 0.6, 0.4), (0.5, 0.8, 0.3)
COUNT, ROUNDS = 2000, 5


def make_poses():
    """4x4 arrays: half of them touch."""
    random.seed(5)
    poses = [ovoid.Pose.from_quaternion([random.uniform(-1.2, 1.2) for _ in range(3)], wxyz=[random.gauss(0, 1) for _ in range(4)])
             for _ in range(COUNT)]
    return poses, [numpy.asarray(pose.matrix) for pose in poses]


def make_ovoid(poses, matrices):
    a, b = ovoid.Shape.box(HALF_A), ovoid.Shape.box(HALF_B)
    bodies = ovoid.Bodies([a] + [b] * COUNT, [ovoid.Pose(), *poses])
    couples = numpy.column_stack([numpy.zeros(COUNT, numpy.uint32), numpy.arange(1, COUNT + 1, dtype=numpy.uint32)])
    apart = ovoid.Status.SEPARATED
    return {"ovoid, a call each": lambda: [ovoid.collide(a, b, None, matrix).status != apart for matrix in matrices],
            "ovoid, one batch": lambda: list(ovoid.collide_batch(bodies, couples)["status"] != apart)}, {
            "ovoid, a call each": lambda: [max(ovoid.distance(a, b, None, matrix).lower, 0) for matrix in matrices],
            "ovoid, one batch": lambda: list(numpy.maximum(ovoid.distance_batch(bodies, couples)["lower"], 0))}


def make_ode(matrices):
    if not ode:
        return {}
    a, b = (ode.GeomBox(None, [2 * size for size in half]) for half in (HALF_A, HALF_B))
    given = [(tuple(matrix[:3, 3]), matrix[:3, :3].ravel().tolist()) for matrix in matrices]

    def collide():
        found = []
        for position, rotation in given:
            b.setPosition(position)
            b.setRotation(rotation)
            found.append(len(ode.collide(a, b)) > 0)
        return found

    return {"ODE (pyode)": collide}


def make_dart(matrices):
    if not dartpy:
        return {}, {}
    collides, distances = {}, {}
    for name, detector in (("FCL", "FCLCollisionDetector"), ("Bullet", "BulletCollisionDetector"), ("ODE", "OdeCollisionDetector")):
        if not hasattr(dartpy.collision, detector):
            continue
        group = getattr(dartpy.collision, detector)().createCollisionGroup()
        frames = []
        for half in (HALF_A, HALF_B):
            frame = dartpy.dynamics.SimpleFrame()
            frame.setShape(dartpy.dynamics.BoxShape([2 * size for size in half]))
            group.addShapeFrame(frame)
            frames.append(frame)
        transforms = []
        for matrix in matrices:
            transform = dartpy.math.Isometry3()
            transform.set_rotation(matrix[:3, :3])
            transform.set_translation(matrix[:3, 3])
            transforms.append(transform)

        def ask(question, group=group, frames=frames, transforms=transforms):
            found = []
            for transform in transforms:
                frames[1].setTransform(transform)
                found.append(question(group))
            return found

        collides[name + " (dartpy)"] = lambda ask=ask: ask(lambda group: group.collide())
        if name == "FCL":
            distances[name + " (dartpy)"] = lambda ask=ask: ask(lambda group: max(group.distance(), 0))
    return collides, distances


def measure(questions, differ, title):
    """Each in turns; the first is what the others are held against."""
    times, answers = {name: [] for name in questions}, {}
    for _ in range(ROUNDS):
        for name, ask in questions.items():
            begin = time.perf_counter()
            answers[name] = ask()
            times[name].append(time.perf_counter() - begin)
    first = next(iter(answers.values()))
    print(f"\n| {title} | ns a pose | answers that differ |\n|---|---:|---:|")
    for name in questions:
        count = sum(differ(i, x, y) for i, (x, y) in enumerate(zip(answers[name], first)))
        print(f"| {name} | {min(times[name]) / COUNT * 1e9:.0f} | {count} |")


def main():
    poses, matrices = make_poses()
    a, b = ovoid.Shape.box(HALF_A), ovoid.Shape.box(HALF_B)
    sure = [abs(ovoid.depth(a, b, None, matrix).lower) > 1e-6 for matrix in matrices]
    collides, distances = make_ovoid(poses, matrices)
    dart_collides, dart_distances = make_dart(matrices)
    for name, found in (("python3-pyode", ode), ("python3-dartpy", dartpy)):
        if not found:
            print(f"without {name}, which is not installed")
    measure({**collides, **make_ode(matrices), **dart_collides}, lambda i, x, y: sure[i] and bool(x) != bool(y), "two boxes: do they touch?")
    measure({**distances, **dart_distances}, lambda i, x, y: abs(x - y) > 1e-6, "two boxes: how far apart?")


if __name__ == "__main__":
    main()
