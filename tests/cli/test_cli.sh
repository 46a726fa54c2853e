#!/bin/sh
# test_cli.sh [--update] [NAME...]: the tool as a user meets it. Each tests/cli/transcripts/NAME.txt is a transcript: "$ command", then
# what it prints (both streams), then "[code]" where the exit code is not 0; "# " lines are remarks. Every command is run
# again, in a folder with a copy of tests/cli/data, and the transcript that comes out must be the one that is stored.
# The sessions of the pages are replayed likewise, those of the start, the tutorials and of robots in a copy of examples/start.
# Truth: the transcripts were read by a person; numbers in them are closed forms of boxes and the like.
# --update stores what comes out: then read the difference.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/need_tool.sh"
update=0
if [ "${1:-}" = --update ]; then update=1 && shift; fi
cases=$OVOID_SOURCE_DIR/tests/cli
work=$OVOID_BUILD_DIR/test_cli
mkdir -p "$work/bin"
ln -sf "$OVOID_TOOL" "$work/bin/ovoid"
PATH=$work/bin:$PATH
LC_ALL=C NO_COLOR=
export PATH LC_ALL NO_COLOR OVOID_SOURCE_DIR OVOID_TOOL

# replay FILE: the transcript of its commands.
replay() {
    while IFS= read -r line; do
        case $line in
        '# '*) printf '%s\n' "$line" ;;
        '$ '*)
            printf '%s\n' "$line"
            sh -c "${line#\$ }" </dev/null 2>&1
            code=$?
            [ $code -eq 0 ] || printf '[%d]\n' "$code"
            ;;
        esac
    done <"$1"
}

# even FILE: without what differs from run to run (times, and the blanks that line them up) or from build to build.
even() {
    sed -E 's/ +[0-9.]+ (m?s)\>/ T \1/g; s/ +[0-9.]+  ([a-z]+\.(off|obj))/ T  \1/; s/(checked in|altered.jsonl:6:).*/\1 .../' "$1"
}

# expect PLACE WANTED [DATA]: replays WANTED in a copy of DATA, by default tests/cli/data, and compares; a failure names the place.
expect() {
    rm -rf "$work/run"
    cp -R "${3:-$cases/data}" "$work/run"
    (cd "$work/run" && replay "$2") >"$work/out"
    even "$2" >"$work/wanted.even"
    even "$work/out" >"$work/out.even"
    if diff -u "$work/wanted.even" "$work/out.even"; then
        passed=$((passed + $(grep -c '^\$ ' "$2")))
    else
        failed=$((failed + 1))
        echo "FAILED $1"
    fi
}

# Planning is a program of its own, which is built where OMPL is.
passed=0 failed=0 skipped=0
[ -x "$(dirname "$OVOID_TOOL")/ovoid-plan" ] || { skipped=1 && echo "skipped: robot plan, which needs libompl-dev (OMPL)"; }
if [ $# -eq 0 ]; then
    for page in tool first-steps tutorial-clearance tutorial-contacts tutorial-robot robot planning; do
        if [ $page = planning ] && [ $skipped -eq 1 ]; then continue; fi
        awk '/^```/ { inside = /console/; next } inside' "$OVOID_SOURCE_DIR/docs/$page.md" >"$work/page"
        if [ $page = tool ]; then data=$cases/data; else data=$OVOID_SOURCE_DIR/examples/start; fi
        expect docs/$page.md "$work/page" "$data"
    done
    for file in "$cases"/transcripts/*.txt; do set -- "$@" "$(basename "$file" .txt)"; done
fi
for name; do
    if [ "$name" = robot_plan ] && [ $skipped -eq 1 ]; then continue; fi
    expect "tests/cli/transcripts/$name.txt" "$cases/transcripts/$name.txt"
    if [ $update -eq 1 ]; then cp "$work/out" "$cases/transcripts/$name.txt"; fi
done
echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
