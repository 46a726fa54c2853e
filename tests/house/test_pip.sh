#!/bin/sh
# The Python package by pip, as docs/python.md says: an sdist of the tree, a wheel of that sdist alone, the wheel in a venv.
# Truth: what pip and the installed package say; one wheel for all versions of CPython by its name; its metadata.
set -u
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
python=/usr/bin/python3
if ! $python -c 'import setuptools, wheel, venv, ensurepip' 2>/dev/null; then
    echo "no python3-setuptools, python3-wheel or python3-venv: skipped"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
folder=$OVOID_BUILD_DIR/test_pip
rm -rf "$folder"
mkdir -p "$folder/source"

# The tree without its builds, as an archive of it has it.
copy_tree() {
    (cd "$OVOID_SOURCE_DIR" && find . \( -name build -o -name 'build-*' -o -name .git -o -name '*.egg-info' \) -prune -o -type f -print0 |
        xargs -0 cp --parents -t "$folder/source")
}
check "a copy of the sources" copy_tree
check "sdist" sh -c "cd '$folder/source' && $python setup.py -q sdist --dist-dir '$folder'"
sdist=$(echo "$folder"/ovoid-*.tar.gz)
check "a venv" $python -m venv --system-site-packages "$folder/venv"
pip=$folder/venv/bin/pip
check "a wheel of the sdist alone" "$pip" -q wheel --no-build-isolation --no-index --no-deps -w "$folder" "$sdist"
wheel=$(echo "$folder"/ovoid-*.whl)
check "one wheel for CPython 3.11 and later" test "$(echo "$wheel" | grep -c 'cp311-abi3-linux')" = 1
check "installed" "$pip" -q install --no-index "$wheel"
answers() {
    cd "$folder" && venv/bin/python -c '
import importlib.metadata, os, ovoid
assert os.path.dirname(ovoid.__file__).startswith(os.path.realpath("venv")), ovoid.__file__
box = ovoid.Shape.box((1, 1, 1))
answer = ovoid.distance(box, box, None, ovoid.Pose.from_rpy((3, 0, 0), (0, 0, 0)))
assert answer.lower <= 1 <= answer.upper and answer.upper - answer.lower < 1e-9, answer
about = importlib.metadata.metadata("ovoid")
assert about["Name"] == "ovoid" and about["License"] == "MIT" and about["Keywords"] and about["Author"], about
assert about.get_all("Classifier") and "# From Python" in about.get_payload()
assert os.path.exists(os.path.join(os.path.dirname(ovoid.__file__), "py.typed"))
robot = hasattr(ovoid, "Robot")
assert robot, "robots are missing"
'
}
check "an answer, and what the package says of itself" answers
# Debian refuses to install into its own Python; the sentence in docs/python.md says what to do instead.
check "docs: a venv is named" grep -q 'python3 -m venv --system-site-packages' "$OVOID_SOURCE_DIR/docs/python.md"
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
