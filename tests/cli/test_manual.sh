#!/bin/sh
# The manual page: clean for mandoc, its options are those of the tables (scripts/manual.py), and it names every command and every option
# that the tool has (and the tool every option that the page names).
set -u
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
if [ ! -x "$OVOID_TOOL" ] || ! command -v mandoc >/dev/null || ! command -v python3 >/dev/null; then
    echo "skipped: the tool, mandoc or python3 is absent"
    echo "0 passed, 0 failed, 1 skipped"
    exit 0
fi
page=$OVOID_SOURCE_DIR/cli/ovoid.1
work=$OVOID_BUILD_DIR/test_manual
mkdir -p "$work"

check_empty lint "$(mandoc -Tlint "$page" 2>&1)"
check_empty tables "$(python3 "$OVOID_SOURCE_DIR/scripts/manual.py" "$OVOID_TOOL" "$page" 2>&1)"

# Options of the tool, and those of the page: "-name" after Fl, or after a comma in a list of them.
: >"$work/tool"
for command in $("$OVOID_TOOL" complete); do
    check_empty "command $command" "$(grep -q "^\.Ss $command\$" "$page" || echo absent)"
    "$OVOID_TOOL" complete "$command" | cut -f 1 | grep '^--' >>"$work/tool"
    for sub in $("$OVOID_TOOL" complete "$command" | awk -F '\t' '$2 == "command" { print $1 }'); do
        check_empty "command $command $sub" "$(grep -q "^\.Ss $command $sub\$" "$page" || echo absent)"
        "$OVOID_TOOL" complete "$command" "$sub" | cut -f 1 | grep '^--' >>"$work/tool"
    done
done
mandoc -Tascii "$page" | sed "s/.$(printf '\b')//g" | grep -oE -- '--[a-z-]+' | sort -u >"$work/page"
echo --version >>"$work/tool"
sort -u -o "$work/tool" "$work/tool"
check_empty options "$(diff "$work/tool" "$work/page")"
echo "$passed passed, $failed failed, 0 skipped"
[ $failed -eq 0 ]
