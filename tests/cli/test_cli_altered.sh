#!/bin/sh
# Results of `ovoid check` with one number or word changed: `ovoid verify` must refuse each of them, and accept what was
# not changed. Truth: each change makes the line claim something false (a bound beyond the other one, another status) or
# something that its proof does not show (points and normals that do not fit).
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/need_tool.sh"
# shellcheck source=tests/cli/altered.sh
. "$(dirname "$0")/altered.sh"
work=$OVOID_BUILD_DIR/test_cli_altered
rm -rf "$work" && cp -R "$OVOID_SOURCE_DIR/tests/cli/data" "$work" && cd "$work" || exit 1

# hold CODE NAME: what verify must say of altered.jsonl, of the scene.
hold() { expect "$1" "$2" altered.jsonl scene.json --partial; }

# vary CODE NAME PROGRAM: of line.jsonl after a sed program.
vary() { alter "$1" "$2" "$3" line.jsonl scene.json --partial; }

"$OVOID_TOOL" check scene.json --json -o all.jsonl 2>/dev/null
count=$(wc -l <all.jsonl)
number='[-+0-9.e]+'
line=0
while [ $line -lt "$count" ]; do
    line=$((line + 1))
    sed -n "${line}p" all.jsonl >line.jsonl
    cp line.jsonl altered.jsonl
    hold 0 "line $line"
    # A bound beyond the other one, by as little as the bracket is wide.
    vary 4 "line $line, lower" "s/\"lower\":$number,\"upper\":($number)/\"lower\":\\1,\"upper\":\\1/"
    vary 4 "line $line, upper" "s/\"lower\":($number),\"upper\":$number/\"lower\":\\1,\"upper\":\\1/"
    vary 4 "line $line, status" 's/"separated"/"overlapping"/; t; s/"overlapping"/"separated"/'
    vary 4 "line $line, touching" 's/"status":"[a-z]+"/"status":"touching"/'
    vary 4 "line $line, point of a" "s/\"point_a\":\\[$number,/\"point_a\":[0.0625,/"
    vary 4 "line $line, point of b" "s/(\"point_b\":\\[$number,)$number,/\\10.0625,/"
    vary 4 "line $line, points" 's/"point_a"(.*)"point_b"/"point_b"\1"point_a"/'
    vary 4 "line $line, normal" 's/"normal":\[[^]]*\]/"normal":[0.6,0.48,0.64]/'
    vary 4 "line $line, normals" 's/"normal":\[[^]]*\]/"normal":[0.6,0.48,0.64]/g'
    vary 4 "line $line, kind" 's/"kind":"[a-z_ ]+"/"kind":"none"/'
    vary 4 "line $line, other bodies" 's/"b":"[a-z]+"/"b":"nobody"/'
    # Each of the digits that matter, of bounds, points and normals: one more, a line each; none may hold. A pair has one
    # result at each time, so each line has its own.
    awk -v line="$(cat line.jsonl)" 'BEGIN { alter("lower", 1, 1, 10); alter("upper", 1, -1, 10); alter("point_a", 3, 0, 5)
            alter("point_b", 3, 0, 5); alter("normal", 3, 0, 9) }
        # The first `most` significant digits of each of the numbers behind the key; sign: only up (1) or down (-1).
        function alter(key, count, sign, most,    at, i, k, from, text, number, changed) {
            at = index(line, "\"" key "\":") + length(key) + 3
            if (count > 1) at++
            for (i = 0; i < count; i++) {
                match(substr(line, at), /^[-+0-9.e]+/)
                text = substr(line, at, RLENGTH)
                number = text + 0
                for (k = 0; k < most; k++) {
                    # The size that the number has counts, but at least a tenth.
                    from = number < 0 ? -number : number
                    changed = number + (sign < 0 ? -1 : 1) * exp(log(10) * (int(log(from > 0.1 ? from : 0.1) / log(10)) - k))
                    if (changed != number)
                        print "{\"time\":" ++time "," substr(line, 2, at - 2) sprintf("%.17g", changed) substr(line, at + length(text))
                }
                at += length(text) + 1
            }
        }' >altered.jsonl
    lines=$(wc -l <altered.jsonl)
    seq "$lines" | awk 'BEGIN { print "time,body,x,y,z,qw,qx,qy,qz" } { print $1 ",floor,0,0,-0.1,1,0,0,0" }' >still.csv
    sed 's/{/{"time":0,/' line.jsonl >still.jsonl
    sed 's/^1,/0,/' still.csv >begin.csv
    expect 0 "line $line, at a time" still.jsonl scene.json --motion begin.csv --partial
    "$OVOID_TOOL" verify altered.jsonl scene.json --motion still.csv --partial >out 2>&1
    if [ "$lines" -gt 50 ] && grep -q "^proofs: $lines, hold: 0, do not: $lines;" out; then
        passed=$((passed + lines))
    else
        failed=$((failed + 1))
        printf 'FAILED line %s, digits: of %s altered lines some hold\n' "$line" "$lines"
        cat out line.jsonl
    fi
    # What is not a result at all is bad input.
    vary 3 "line $line, no number" "s/\"lower\":$number/\"lower\":\"far\"/"
    vary 3 "line $line, no status" 's/"status":"[a-z]+"/"status":"near"/'
    vary 3 "line $line, cut off" 's/.{20}$//'
done
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
