# page_check.py TOOL DATA: the data of --html, read back. Run by test_page.sh in an empty folder.
# Truth: the lines of `ovoid check --json`, the files of `ovoid fit`, the numbers given; octants of affine tetrahedra, whose
# largest inner ellipsoid is the image of the sphere in a regular one. What a browser would be given is read as one would.
import array, base64, html.parser, itertools, json, math, os, random, struct, subprocess, sys

tool = os.path.abspath(sys.argv[1])
counts = {"passed": 0, "failed": 0}


def check(what, is_true):
    counts["passed" if is_true else "failed"] += 1
    if not is_true:
        print("FAILED", what)


def run(*args):
    done = subprocess.run([tool, *args], capture_output=True)
    if done.returncode not in (0, 1, 4):
        print("FAILED", args, done.stderr.decode())
    return done.stdout.decode(), done.stderr.decode()


class Scripts(html.parser.HTMLParser):
    """The text of the script element, as a browser finds it."""

    def __init__(self):
        super().__init__()
        self.inside, self.texts = False, []

    def handle_starttag(self, tag, attributes):
        self.inside = tag == "script" and dict(attributes).get("id") == "ovoid-data"

    def handle_endtag(self, tag):
        self.inside = False

    def handle_data(self, data):
        if self.inside:
            self.texts.append(data)


def read(path):
    with open(path, encoding="utf-8", errors="strict") as file:
        text = file.read()
    before, *found = text.split('<script id="ovoid-data" type="application/json">')
    found, *after = found[0].split("</script>")
    check("one script in " + path, len(after) == 1 and before.endswith("<p>before</p>") and after[0].startswith("<p>after</p>"))
    # The parser of HTML takes seconds for megabytes.
    if len(text) < 100000:
        parser = Scripts()
        parser.feed(text)
        check("script of " + path, "".join(parser.texts) == found)
    return json.loads(found)


def numbers(kind, text):
    data = array.array(kind, base64.b64decode(text, validate=True))
    if sys.byteorder == "big":
        data.byteswap()
    return data


def write(path, value):
    with open(path, "w") as file:
        file.write(json.dumps(value))


def without_names(line):
    return {key: value for key, value in line.items() if key not in ("a", "b")}


def lines(*args):
    return [json.loads(line) for line in run(*args)[0].splitlines()]


def is_dent(kind, mesh):
    """Whether the arrays are 20 triangles that enclose 3, that of the first corners first."""
    points, triangles = numbers(kind, mesh["points"]), numbers("I", mesh["triangles"])
    at = [points[3 * i:3 * i + 3] for i in triangles]
    volume = sum(p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0])
                 for p, q, r in zip(at[0::3], at[1::3], at[2::3])) / 6
    is_first = [list(p) for p in at[:3]] == [[0, 0, 0], [2, 0, 0], [2, 0, 1]]
    return len(points) == 36 and len(triangles) == 60 and is_first and abs(volume - 3) < 1e-6


def check_scene():
    # A name that looks like the members that are taken out, and one that would end a string.
    rows = [{"name": 'a","b":"', "box": [1, 2, 3]}, {"name": '\\"b":\\', "mesh": "dent.off", "pose": {"xyz": [3, 0, 0]}},
            {"name": "c", "compound": [{"sphere": 0.5}, {"box": [1, 1, 1], "pose": {"xyz": [0, 0, 2]}}], "pose": {"xyz": [0, 9, 0], "rpy": [0, 1, 0]}}]
    # A prism with a dent: an L of polygons.
    corners = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    with open("dent.off", "w") as file:
        file.write("OFF\n12 10 0\n" + "".join(f"{x} {y} {z}\n" for z in (0, 1) for x, y in corners))
        file.write("".join(f"4 {i} {(i + 1) % 6} {(i + 1) % 6 + 6} {i + 6}\n" for i in range(6)))
        file.write("4 3 2 1 0\n4 5 4 3 0\n4 6 7 8 9\n4 6 9 10 11\n")
    write("scene.json", {"unit": "mm", "objects": rows})
    results = lines("check", "scene.json", "--margin", "50", "--json", "--html", "scene.html")
    data = read("scene.html")
    names = [body["name"] for body in data["bodies"]]
    check("head", [data[key] for key in ("format", "title", "unit", "margin")] == [1, "scene.json", "mm", 50] and "left_out" not in data)
    check("names", names == [row["name"] for row in rows])
    check("pairs", [(names[p["a"]], names[p["b"]], p["answer"]) for p in data["pairs"]]
          == [(line["a"], line["b"], without_names(line)) for line in results] and len(results) == 3)
    check("poses", data["bodies"][1]["pose"] == {"xyz": [3, 0, 0], "quat_wxyz": [1, 0, 0, 0]}
          and abs(data["bodies"][2]["pose"]["quat_wxyz"][2] - math.sin(0.5)) < 1e-15)
    check("parts", [len(body["parts"]) for body in data["bodies"]] == [1, 1, 2] and "pose" not in data["bodies"][2]["parts"][0]
          and data["bodies"][2]["parts"][1]["pose"]["xyz"] == [0, 0, 2])
    shapes = data["shapes"]
    check("shapes", sorted(part["shape"] for body in data["bodies"] for part in body["parts"]) == [0, 1, 2, 3] and len(shapes) == 4)
    run("fit", "dent.off", "--output", "dent.ovoid")
    dent = shapes[data["bodies"][1]["parts"][0]["shape"]]
    with open("dent.ovoid", "rb") as file:
        check("bytes", base64.b64decode(dent["bytes"], validate=True) == file.read())
    check("solid", is_dent("d", dent["solid"]) and [body.get("solid") for body in data["bodies"]] == [None, True, None])
    check("meshes of hulls", sum("solid" in shape or "mesh" in shape for shape in shapes) == 1)
    check("areas", [len(base64.b64decode(shape.get("areas", ""))) for shape in shapes].count(0) == 1)
    # Two files, with their pair: their hulls where those are asked for, else what they are.
    write("pair.json", {"objects": [{"name": str(x), "mesh": "dent.off", "solid": False, "pose": {"xyz": [x, 0, 0]}} for x in (0, 5)]})
    wanted = lines("check", "pair.json", "--json")[0]
    run("view", "dent.off", "dent.off", "--pose-b", "5 0 0", "--html", "solids.html")
    data = read("solids.html")
    check("solids of files", is_dent("d", data["shapes"][0]["solid"]) and [body.get("solid") for body in data["bodies"]] == [True, True])
    run("view", "dent.off", "dent.off", "--pose-b", "5 0 0", "--hull", "--html", "pair.html")
    data = read("pair.html")
    check("mesh", is_dent("f", data["shapes"][0]["mesh"]) and not any("solid" in item for item in data["shapes"] + data["bodies"]))
    check("files", data["title"] == "dent.off, dent.off" and len(data["bodies"]) == 2 and data["unit"] is data["margin"] is None)
    check("answer of files", [data["pairs"][0]["answer"][key] for key in ("lower", "upper", "proof")] == [wanted[key] for key in ("lower", "upper", "proof")])


def multiply(a, b):
    return [[sum(a[i][m] * b[m][k] for m in range(3)) for k in range(3)] for i in range(3)]


def invert(a):
    cofactors = [[a[(i + 1) % 3][(k + 1) % 3] * a[(i + 2) % 3][(k + 2) % 3] - a[(i + 1) % 3][(k + 2) % 3] * a[(i + 2) % 3][(k + 1) % 3]
                  for k in range(3)] for i in range(3)]
    determinant = sum(a[0][k] * cofactors[0][k] for k in range(3))
    return [[cofactors[k][i] / determinant for k in range(3)] for i in range(3)]


def make_inverse_root(q):
    # E. D. Denman, A. N. Beavers, 1976.
    y, z = q, [[float(i == k) for k in range(3)] for i in range(3)]
    for _ in range(60):
        y, z = ([[(p[i][k] + r[i][k]) / 2 for k in range(3)] for i in range(3)] for p, r in ((y, invert(z)), (z, invert(y))))
    return z


def check_areas():
    random.seed(5)
    regular = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    rows, wanted = [], []
    while len(rows) < 30:
        affine = [[random.gauss(0, 1) for _ in range(3)] for _ in range(3)]
        root = make_inverse_root(multiply(affine, [list(row) for row in zip(*affine)]))
        points = [[sum(row[k] * p[k] for k in range(3)) + 7 for row in affine] for p in regular]
        # The middle of the face opposite to a corner is -1/3 of it.
        images = [[sum(r * (7 - x) / 3 for r, x in zip(row, p)) for row in root] for p in points]
        if min(abs(x) for image in images for x in image) < 0.02:
            continue
        rows.append({"name": str(len(rows)), "points": points, "pose": {"xyz": [50 * len(rows), 0, 0]}})
        wanted.append(sorted(sum((x < 0) << i for i, x in enumerate(image)) for image in images))
    write("areas.json", {"objects": rows})
    run("view", "areas.json", "--html", "areas.html")
    data = read("areas.html")
    found = [sorted(base64.b64decode(data["shapes"][body["parts"][0]["shape"]]["areas"])) for body in data["bodies"]]
    check("octants", found == wanted)


def check_many():
    # 10 164 balls on a jittered grid: the nearest pairs, then their bodies, then others in their order.
    random.seed(3)
    rows = [{"name": f"n{len(str(i))}-{i}", "sphere": 0.3, "pose": {"xyz": [x + random.uniform(-0.04, 0.04) for x in (i % 22, i // 22 % 22, i // 484)]}}
            for i in range(10164)]
    write("many.json", {"objects": rows})
    text, said = run("check", "many.json", "--margin", "0.425", "--json", "--html", "many.html")
    results, data, chosen, wanted = [json.loads(line) for line in text.splitlines()], read("many.html"), set(), []
    for line in results:
        couple = {line["a"], line["b"]}
        if len(wanted) < 20000 and len(chosen) + len(couple - chosen) <= 10000:
            chosen |= couple
            wanted.append((line["a"], line["b"], line["lower"], line["upper"]))
    for row in rows:
        if len(chosen) < 10000:
            chosen.add(row["name"])
    names = [body["name"] for body in data["bodies"]]
    check("bodies of many", len(results) > 21000 and names == [row["name"] for row in rows if row["name"] in chosen] and len(names) == 10000)
    check("pairs of many", [(names[p["a"]], names[p["b"]], p["answer"]["lower"], p["answer"]["upper"]) for p in data["pairs"]] == wanted)
    left = {"pairs": len(results) - len(wanted), "bodies": 164}
    check("left out of many", data["left_out"] == left and f"pairs: {left['pairs']}, bodies: 164" in said)
    check("one shape of many", len(data["shapes"]) == 1)


def check_meshes():
    # Few points, and faces there many times: the hulls of 61 files of half a megabyte of triangles.
    points = [(math.cos(i), math.sin(i), i % 3) for i in range(30)]
    with open("crowd.ply", "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex 30\nproperty float x\nproperty float y\nproperty float z\n"
                   b"element face 45000\nproperty list uchar int vertex_indices\nend_header\n")
        file.write(b"".join(struct.pack("<3f", *p) for p in points))
        file.write(b"".join(struct.pack("<B3i", 3, i, (i + 1) % 30, (i + 7) % 30) for i in range(30)) * 1500)
    rows = [{"name": str(i), "mesh": "crowd.ply", "hull": True, "scale": 1 + i / 64, "pose": {"xyz": [10 * i * i, 0, 0]}} for i in range(61)]
    write("meshes.json", {"objects": rows[::-1]})
    said = run("check", "meshes.json", "--html", "meshes.html")[1]
    data = read("meshes.html")
    with_mesh = [body["name"] for body in data["bodies"] if "mesh" in data["shapes"][body["parts"][0]["shape"]]]
    # 12 bytes a triangle and a point; the nearest are those of low numbers.
    most = 30000000 // (12 * 45030)
    check("meshes", sorted(map(int, with_mesh)) == list(range(most)))
    check("left out of meshes", data["left_out"] == {"meshes": 61 - most} and f"meshes: {61 - most}" in said)


def check_proofs():
    # Hulls about one point: proofs of depths, five kilobytes each.
    random.seed(9)
    points = [[random.gauss(0, 1) for _ in range(3)] for _ in range(300)]
    points = [[x / math.hypot(*p) for x in p] for p in points]
    rows = [{"name": str(i), "points": points, "pose": {"xyz": [i / 1e3, i * i / 1e5, 0], "rpy": [i, 0, 0]}} for i in range(112)]
    write("proofs.json", {"objects": rows})
    done = subprocess.run([tool, "check", "proofs.json", "--json", "--html", "proofs.html"], capture_output=True, text=True)
    sizes = [len(line) - line.index('"proof":') - 1 for line in done.stdout.splitlines()]
    data = read("proofs.html")
    given = ["proof" in pair["answer"] for pair in data["pairs"]]
    most = sum(1 for end in itertools.accumulate(sizes) if end <= 20000000)
    check("proofs", most < len(sizes) and given == [True] * most + [False] * (len(sizes) - most) and data["left_out"] == {"proofs": len(sizes) - most})
    check("left out of proofs", f"proofs: {len(sizes) - most}" in done.stderr)


def check_motion():
    frames = 5003
    with open("motion.csv", "w") as file:
        file.write("time,body,x,y,z,qw,qx,qy,qz\n")
        for i in range(frames):
            file.write(f"{i / 8},ball,{2.5 + abs(i - 2600) / 500!r},0,0,1,0,0,{i / 1000!r}\n")
    write("motion.json", {"objects": [{"name": "box", "box": [1, 1, 1], "pose": {"xyz": [0, 0, 0.25]}}, {"name": "ball", "sphere": 1},
                                      {"name": "far", "box": [1, 1, 1], "pose": {"xyz": [0, 100, 0]}}]})
    said = run("run", "motion.json", "--motion", "motion.csv", "--margin", "1.5", "--csv", "-o", "motion.out", "--html", "motion.html")[1]
    data = read("motion.html")
    motion, poses = data["motion"], numbers("d", data["motion"]["poses"])
    kept = list(range(0, frames, 4)) + [frames - 1]
    check("times", motion["times"] == [i / 8 for i in kept] and data["left_out"] == {"frames": frames - len(kept)} and f"frames: {frames - len(kept)}" in said)
    check("poses of frames", len(poses) == 21 * len(kept) and all(
        list(poses[21 * f:21 * f + 14]) == [0, 0, 0.25, 1, 0, 0, 0, 2.5 + abs(i - 2600) / 500, 0, 0, 1, 0, 0, i / 1000] for f, i in enumerate(kept)))
    check("margin of frames", motion["margin"] == 1.5)
    # The one pair within the margin, where it is nearest: frame 2600 is kept as number 650.
    pair = data["pairs"][0]
    check("nearest frame", len(data["pairs"]) == 1 and [pair[key] for key in ("a", "b", "frame")] == [0, 1, 650])
    write("still.json", {"objects": [{"name": "box", "box": [1, 1, 1], "pose": {"xyz": [0, 0, 0.25]}},
                                     {"name": "ball", "sphere": 1, "pose": {"xyz": [2.5, 0, 0], "quat_wxyz": [1, 0, 0, 2.6]}}]})
    check("answer of a frame", pair["answer"] == without_names(lines("check", "still.json", "--margin", "1.5", "--json")[0]))
    # At 1.5 exactly, in frame 2350, the side of the margin is left open.
    check("first within", motion["events"] == [{"time": 2351 / 8, "from": 2350 / 8, "a": 0, "b": 1, "kind": "within"}])


def check_robot():
    arm = os.path.join(sys.argv[2], "arm")
    robot = [f"{arm}/arm.urdf", "--srdf", f"{arm}/arm.srdf", "--parts", "--scene", f"{arm}/cell.yaml"]
    info = lines("robot", "info", *robot[:4], "--json")[0]
    answers = lines("robot", "check", *robot, "--states", f"{arm}/states.csv", "--near", "9", "--json", "--html", "states.html")
    data = read("states.html")
    given = data["robot"]
    with open(f"{arm}/states.csv") as file:
        names, *rows = [line.strip().split(",") for line in file if line.strip() and line[0] != "#"]
    check("links", given["links"] == [link["name"] for link in info["links"]] and given["variables"] == [v["joint"] for v in info["variables"]])
    plain = [{key: value for key, value in joint.items() if key not in ("multiplier", "offset")} for joint in info["joints"]]
    check("joints", [{**joint, "mimic": joint["mimic"]["joint"]} if "mimic" in joint else joint for joint in given["joints"]] == plain)
    check("mimic", [joint["mimic"] for joint in given["joints"] if "mimic" in joint] == [{"joint": "left_slide", "multiplier": -1, "offset": 0}])
    check("elements", [(e["link"], e["pose"]) for e in given["elements"]] == [(e["link"], e["pose"]) for e in info["elements"]]
          and len({e["shape"] for e in given["elements"]} | {o["shape"] for o in given["obstacles"]}) == len(data["shapes"]))
    check("obstacles", [o["name"] for o in given["obstacles"]] == ["table", "pillar"] and given["obstacles"][0]["pose"]["xyz"] == [1, 0, 0.4])
    check("states", [[row[given["variables"].index(name)] for name in names] for row in given["states"]] == [list(map(float, row)) for row in rows])
    check("answers", given["answers"] == answers and data["bodies"] == data["pairs"] == [] and data["unit"] == "m" and "path" not in given)
    # A pair of links is queried or disabled: near within 9 m finds all that are queried.
    queried = {tuple(pair[side]["link"] for side in "ab") for answer in answers for pair in answer.get("near", []) if "link" in pair["b"]}
    links = [link for link in given["links"] if any(e["link"] == link for e in given["elements"])]
    every = {(a, b) for i, a in enumerate(links) for b in links[i + 1:]}
    check("disabled", {tuple(pair) for pair in given["disabled"]} == every - queried and len(queried) > 1)
    path = lines("robot", "path", *robot, "--states", f"{arm}/path.csv", "--margin", "0.01", "--json", "--html", "path.html")
    data = read("path.html")
    given = data["robot"]
    check("path", given["path"]["edges"] == path and data["margin"] == 0.01 and given["answers"] == [] and len(given["states"]) == 3)
    samples = {sample[0]: sample for sample in given["path"]["clearance"]}
    for i, answer in enumerate(lines("robot", "check", *robot, "--states", f"{arm}/path.csv", "--near", "9", "--json")):
        nearest = answer["near"][0]
        check("clearance", samples[i][3:] == [nearest["a"], nearest["b"]] and samples[i][1] <= nearest["upper"] and nearest["lower"] <= samples[i][2])
    steps, pairs = given["path"]["steps"], given["path"]["pairs"]
    named = {number for step in steps for number in step[3]}
    check("steps", len(steps) == path[0]["steps"] > 0 and named == set(range(len(pairs))) and all(step[2] in ("outer", "middle", "ends", "solid") for step in steps))
    check("pairs", all(any(number in step[3] and step[0] == 0 for step in steps) for number in named))
    check("samples", len(samples) == 101 and sorted(samples) == [s[0] for s in given["path"]["clearance"]])
    edges = lines("robot", "path", *robot, "--state", "up", "--state", "shoulder=1.4", "--state", "up", "--state", "shoulder=0.1", "--edges", "--json", "--html", "edges.html")
    data = read("edges.html")
    check("edges", data["robot"]["path"] == {"edges": edges} and [edge["status"] for edge in edges] == ["hit", "free"])


def check_held():
    # A rod in the tip, a padded arm, and a scene that replaces what the SRDF disables.
    link = '<link name="{}"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>'
    joint = '<joint name="to {1}" type="prismatic"><parent link="{0}"/><child link="{1}"/><origin xyz="1 0 0"/><limit lower="-1" upper="1"/></joint>'
    with open("held.urdf", "w") as file:
        file.write('<robot name="r">' + "".join(map(link.format, "abc")) + joint.format("a", "b") + joint.format("b", "c")
                   + '<link name="e"><collision><geometry><mesh filename="dent.off"/></geometry></collision></link>' + joint.format("a", "e") + "</robot>")
    with open("held.yaml", "w") as file:
        file.write("""robot_state:
  attached_collision_objects:
    - {link_name: c, touch_links: [b], object: {id: rod, header: {frame_id: c}, primitives: [{type: sphere, dimensions: [0.2]}]}}
link_padding: [{link_name: b, padding: 0.25}]
world: {collision_objects: [{id: post, primitives: [{type: sphere, dimensions: [0.3]}], primitive_poses: [{position: [0, 9, 0]}]}]}
allowed_collision_matrix: {entry_names: [a, b, c, post, e], entry_values: [[0, 1, 0, 0, 0], [1, 0, 0, 1, 0], [0, 0, 0, 0, 0], [0, 1, 0, 0, 0], [0, 0, 0, 0, 0]]}
""")
    run("robot", "check", "held.urdf", "--scene", "held.yaml", "--state", "to b=0.1", "--limit-slack", "0.5", "--html", "held.html")
    data = read("held.html")
    given = data["robot"]
    dents = [e for e in given["elements"] if e.get("solid")]
    check("links that are no hulls", [e["link"] for e in dents] == ["e"] and is_dent("d", data["shapes"][dents[0]["shape"]]["solid"]))
    check("held", [(h["name"], h["link"], h["touching"]) for h in given["held"]] == [("rod", "c", ["b", "c"])])
    check("allowed", given["disabled"] == [["a", "b"]] and [(o["name"], o["touching"]) for o in given["obstacles"]] == [("post", ["b"])])
    check("paddings", given["paddings"] == [["b", 0.25]] and given["limit_slack"] == 0.5)


def check_rigid():
    # c moves, a and b never against each other; d has nothing to collide with.
    link = '<link name="{}"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>'
    joint = '<joint name="to {1}" type="{2}"><parent link="{0}"/><child link="{1}"/><limit lower="-1" upper="1"/></joint>'
    with open("rigid.urdf", "w") as file:
        file.write('<robot name="r">' + "".join(map(link.format, "abc")) + '<link name="d"/>' + joint.format("a", "d", "fixed")
                   + joint.format("d", "b", "fixed") + joint.format("b", "c", "revolute") + "</robot>")
    run("robot", "check", "rigid.urdf", "--state", "", "--html", "rigid.html")
    check("rigid pairs", read("rigid.html")["robot"]["disabled"] == [["a", "b"]])


def check_many_states():
    arm = os.path.join(sys.argv[2], "arm")
    with open("states.csv", "w") as file:
        file.write("time,shoulder\n" + "".join(f"{i},{i / 1e6!r}\n" for i in range(10004)))
    robot = [f"{arm}/arm.urdf", "--hull", "--states", "states.csv", "--csv", "-o", "states.out"]
    said = run("robot", "check", *robot, "--html", "many_states.html")[1]
    data = read("many_states.html")
    check("many states", [len(data["robot"][key]) for key in ("states", "answers")] == [10000] * 2 and data["left_out"] == {"states": 4}
          and [answer["state"] for answer in data["robot"]["answers"]] == list(range(10000)) and "states: 4" in said)
    check("times of states", data["robot"]["times"] == list(range(10000)))
    run("robot", "path", *robot, "--edges", "--html", "many_edges.html")
    data = read("many_edges.html")
    check("many edges", len(data["robot"]["path"]["edges"]) == 5000 and data["left_out"] == {"states": 4})


tests = [check_scene, check_areas, check_many, check_meshes, check_proofs, check_motion]
if "robot" in run("complete")[0].split():
    tests += [check_robot, check_held, check_rigid, check_many_states]
for each in tests:
    each()
print(f"{counts['passed']} passed, {counts['failed']} failed, 0 skipped")
sys.exit(counts["failed"] > 0)
