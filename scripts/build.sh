#!/bin/sh
# build.sh FOLDER TARGET...: configures the preset release in FOLDER where that is not done, and builds the targets, with a line for
# each tenth of the work. What the build says goes to FOLDER/said.log, and is shown where it fails. JOBS: how many at a time.
set -eu
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.."
folder=$1
shift
mkdir -p "$folder"
said=$folder/said.log
echo "building $* in $folder; a minute or two on a fresh copy; $said has what the build says"
cmake --preset release >"$said" 2>&1 || { cat "$said" && exit 1; }
# The exit code of the build, which stands before a pipe, comes through a file.
{ cmake --build "$folder" -j"${JOBS:-$(nproc)}" --target "$@" 2>&1 && echo 0 >"$folder/said.code" || echo 1 >"$folder/said.code"; } |
    tee "$said" | awk '/^\[ *[0-9]+%\]/ {
        share = 10 * int(substr($0, 2, 3) / 10)
        if (share > last) { printf "  %d %% built\n", share; fflush(); last = share }
    }'
[ "$(cat "$folder/said.code")" = 0 ] && exit 0
grep -E -A6 'error|Error' "$said" || tail -20 "$said"
exit 1
