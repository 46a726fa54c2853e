#!/bin/sh
# What long commands say while they work: on a terminal a line that is drawn again and again, and is gone at the end; nothing where
# stderr is no terminal. Truth: the words of the line, and the bytes that clear it.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/need_tool.sh"
command -v python3 >/dev/null || { echo "skipped: python3, which opens a terminal" && echo "0 passed, 0 failed, 1 skipped" && exit 0; }
cd "$OVOID_SOURCE_DIR/tests/cli/data" || exit 1
python3 - "$OVOID_TOOL" <<'EOF'
import os
import pty
import re
import subprocess
import sys

passed = failed = 0


def check(name, good, shown):
    global passed, failed
    passed += bool(good)
    failed += not good
    if not good:
        print(f"FAILED {name}: {shown[:300]!r}")


def read_terminal(argv):
    """What a command writes to a terminal."""
    child, terminal = pty.fork()
    if child == 0:
        os.execv(argv[0], argv)
    text = b""
    while True:
        try:
            piece = os.read(terminal, 65536)
        except OSError:  # Linux: the other end is closed
            break
        if not piece:
            break
        text += piece
    os.waitpid(child, 0)
    return text.decode()


tool = sys.argv[1]
matrix = [tool, "robot", "matrix", "arm/arm.urdf", "--samples", "300000"]
spheres = [tool, "robot", "spheres", "arm/arm.urdf", "--count", "1", "--rounds", "10", "--cells", "4096"]
LINES = {"matrix": (matrix, r"\r\d+ groups of states and cells of joint space, \d+ s(, \d+/s)? \x1b\[K"),
         "spheres": (spheres, r"\r\[[#.]{28}\] +\d+ %  \d of 5 links, \d+ s[^\x1b]* \x1b\[K")}
for name, (command, line) in LINES.items():
    shown = read_terminal(command)
    found = list(re.finditer(line, shown))
    check(f"{name}: a line", found, shown)
    rest = shown[found[-1].end():] if found else ""
    check(f"{name}: the line is cleared before the answer", rest.startswith("\r\x1b[K") and "links" not in rest.split("\n")[0][4:], rest)
    quiet = subprocess.run(command, capture_output=True, text=True)
    check(f"{name}: nothing where there is no terminal", "\x1b" not in quiet.stdout + quiet.stderr, quiet.stderr)
print(f"{passed} passed, {failed} failed, 0 skipped")
sys.exit(failed > 0)
EOF
