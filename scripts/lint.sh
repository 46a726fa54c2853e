#!/bin/sh
# lint.sh [STEP...]: floors, format, shell, tidy; all of them where none is named. format-in-place rewrites the sources.
# Says what is wrong; exit 1 where anything is.
set -u
# shellcheck source=scripts/help.sh
. "$(dirname "$0")/help.sh"
cd "$(dirname "$0")/.." || exit 1

sources() { find src include adapters cli judge bench examples fuzz packaging python tests web/src \( -name '*.[ch]' -o -name '*.[ch]pp' \) -print; }

run_step() {
    case $1 in
    floors) scripts/check-floors ;;
    format) sources | xargs clang-format --dry-run -Werror ;;
    format-in-place) sources | xargs clang-format -i ;;
    shell) find scripts tests cli -name '*.sh' -exec shellcheck scripts/check-floors scripts/check-links .ci/run {} + ;;
    tidy)
        # With the compile commands of the clang build; tests and C++ are left to the compilers' own warnings. The paths that led
        # to a finding stay in the log.
        cmake --preset check >/dev/null &&
            sed -n 's|^ *"file": "\(.*\)".*|\1|p' build/check/compile_commands.json | grep -v '/\(tests\|build\)/\|\.cpp$' | sort -u |
            xargs -n 4 -P "${JOBS:-2}" clang-tidy --quiet --warnings-as-errors='*' -p build/check >build/tidy.log 2>&1
        tidy=$?
        grep -A 2 ' error: ' build/tidy.log
        return $tidy
        ;;
    *) echo "lint: no such step: $1" >&2 && return 2 ;;
    esac
}

[ $# -gt 0 ] || set -- floors format shell tidy
bad=0
for step in "$@"; do run_step "$step" || bad=1; done
exit $bad
