#!/usr/bin/env python3
"""assembly.py MESH...: a scene of --count parts of these meshes on a grid, for `ovoid check`, to standard output.

Each mesh is scaled so that its box's longest side is 1, turned by quarter turns about its axes and put into a cell of its own, whose side is
1 + --gap; --tilt turns it further, by up to that many degrees about a random axis, so that neighbours may meet. Meshes that do not
exist or hold no vertex are an error. The same arguments give the same scene.
"""

import argparse
import json
import math
import os
import random
import struct
import sys


def read_points(path):
    """The vertices of an OBJ or STL file."""
    with open(path, "rb") as file:
        data = file.read()
    if path.lower().endswith(".stl") and len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        count = struct.unpack_from("<I", data, 80)[0]
        return [struct.unpack_from("<3f", data, 84 + 50 * i + 12 * k) for i in range(count) for k in (1, 2, 3)]
    word = "vertex" if path.lower().endswith(".stl") else "v"
    lines = (line.split() for line in data.decode("utf-8", "replace").splitlines())
    return [tuple(float(x) for x in words[1:4]) for words in lines if words and words[0] == word]


def multiply(p, q):
    """The product of two quaternions (w, x, y, z)."""
    a, b, c, d = p
    e, f, g, h = q
    return (a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e)


def turn(q, v):
    """A vector, turned by a unit quaternion."""
    w, x, y, z = multiply(multiply(q, (0.0, *v)), (q[0], -q[1], -q[2], -q[3]))
    return (x, y, z)


def choose_rotation(numbers, tilt):
    """Quarter turns about the axes, then up to `tilt` degrees about any."""
    q = (1.0, 0.0, 0.0, 0.0)
    half = math.sqrt(0.5)
    for axis in range(3):
        for _ in range(numbers.randrange(4)):
            step = [half, 0.0, 0.0, 0.0]
            step[1 + axis] = half
            q = multiply(q, step)
    axis = [numbers.gauss(0, 1) for _ in range(3)]
    norm = math.sqrt(sum(x * x for x in axis))
    angle = math.radians(tilt) * numbers.random() / 2
    return multiply((math.cos(angle), *(math.sin(angle) * x / norm for x in axis)), q)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--gap", type=float, default=0.01)
    parser.add_argument("--tilt", type=float, default=0)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    numbers = random.Random(given.seed)
    known = []
    for path in given.meshes:
        points = read_points(path)
        if not points:
            sys.exit(f"assembly.py: {path} has no vertices")
        low = [min(p[k] for p in points) for k in range(3)]
        high = [max(p[k] for p in points) for k in range(3)]
        scale = 1 / max(h - l for l, h in zip(low, high))
        known.append((os.path.abspath(path), scale, [(l + h) / 2 * scale for l, h in zip(low, high)]))
    side = math.ceil(given.count ** (1 / 3))
    objects = []
    for i in range(given.count):
        path, scale, center = known[i % len(known)]
        q = choose_rotation(numbers, given.tilt)
        off = turn(q, center)
        cell = (i % side, i // side % side, i // side**2)
        xyz = [(1 + given.gap) * c - o for c, o in zip(cell, off)]
        objects.append({"name": f"part {i}", "mesh": path, "scale": scale, "pose": {"xyz": xyz, "quat_wxyz": list(q)}})
    print('{"objects": [\n ' + ",\n ".join(json.dumps(o) for o in objects) + "\n]}")


main()
