#!/bin/sh
# Path proofs of `ovoid robot path` with one number or word changed for the worse: `ovoid verify` must refuse each of
# them, and accept what was not changed. Truth: each change leaves a part of the path without a step, turns a normal
# around, gives a step to another pair, or makes the answer say what its steps do not show.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/need_tool.sh"
# shellcheck source=tests/cli/altered.sh
. "$(dirname "$0")/altered.sh"
work=$OVOID_BUILD_DIR/test_cli_altered_paths
rm -rf "$work" && cp -R "$OVOID_SOURCE_DIR/tests/cli/data" "$work" && cd "$work" || exit 1
if ! "$OVOID_TOOL" robot path --help >/dev/null 2>&1; then
    echo "0 passed, 0 failed, 1 skipped (this ovoid has no robots)"
    exit 0
fi

# spoil FILE: every number of every step for the worse, a copy of the path each; none may hold.
spoil() {
    awk '
        NR == 1 { source = $0; next }
        NR == 2 { answer = $0; until = get($0, "free_until") + 0; next }
        { step[++count] = $0 }
        # The number behind the key.
        function get(line, key) {
            if (!match(line, "\"" key "\":")) return "none"
            line = substr(line, RSTART + RLENGTH)
            match(line, /^[-+0-9.e]+/)
            return substr(line, 1, RLENGTH)
        }
        function set(line, key, value,    at) {
            match(line, "\"" key "\":")
            at = RSTART + RLENGTH
            match(substr(line, at), /^[-+0-9.e]+/)
            return substr(line, 1, at - 1) sprintf("%.17g", value) substr(line, at + RLENGTH)
        }
        # A copy of the path whose step i is another.
        function put(i, line,    k, copy) {
            copy = answer
            sub(/"path":[0-9]+/, "\"path\":" made++, copy)
            print copy >"copies"
            for (k = 1; k <= count; k++) print (k == i ? line : step[k]) >"copies"
        }
        END {
            for (i = 1; i <= count; i++) {
                begin = get(step[i], "begin") + 0; end = get(step[i], "end") + 0
                # What is behind free_until is not wanted.
                if (begin >= until) continue
                for (k = 1; k <= 7; k++) {
                    worse = begin + (end - begin) * exp(-k * log(10))
                    if (worse < until) put(i, set(step[i], "begin", worse))
                    worse = end - (end - begin) * exp(-k * log(10))
                    if (worse < until) put(i, set(step[i], "end", worse))
                }
                put(i, set(step[i], "begin", -1)); put(i, set(step[i], "end", begin)); put(i, set(step[i], "end", 1e300))
                line = step[i]
                if (match(line, /"normal":\[[^]]*\]/)) {
                    text = substr(line, RSTART, RLENGTH)
                    gsub(/[-0-9.e+]+/, "-&", text); gsub(/--/, "", text); gsub(/e--?/, "e-", text)
                    put(i, substr(line, 1, RSTART - 1) text substr(line, RSTART + RLENGTH))
                    put(i, substr(line, 1, RSTART - 1) "\"normal\":[0,0,0]" substr(line, RSTART + RLENGTH))
                }
                # Each pair in turn is left out, or where it is the only one, is another one.
                match(line, /"pairs":\[[^]]*\]/)
                n = split(substr(line, RSTART + 9, RLENGTH - 10), pairs, ",")
                for (k = 1; k <= n; k++) {
                    text = ""
                    for (m = 1; m <= n; m++) if (m != k) text = text (text == "" ? "" : ",") pairs[m]
                    if (n == 1) text = pairs[1] ? pairs[1] - 1 : 1
                    put(i, substr(line, 1, RSTART + 8) text "]}")
                }
                put(i, substr(line, 1, RSTART + 8) "1000000]}")
            }
            sub(/"paths":[0-9]+/, "\"paths\":" made, source)
            print source
        }' "$1" >altered.jsonl
    cat copies >>altered.jsonl
    "$OVOID_TOOL" verify altered.jsonl >out 2>&1
    copies=$(grep -c '"path"' altered.jsonl)
    if [ "$copies" -gt 100 ] && grep -q "^paths: $copies, hold: 0, do not: $copies;" out; then
        passed=$((passed + copies))
    else
        failed=$((failed + 1))
        printf 'FAILED %s: of %s altered paths some hold\n' "$1" "$copies"
        tail -3 out
    fi
}

cell="arm/arm.urdf --srdf arm/arm.srdf --parts --scene arm/cell.yaml"
# shellcheck disable=SC2086 # a list of options
"$OVOID_TOOL" robot path $cell --states arm/path.csv --margin 0.01 --proofs -o free.jsonl 2>/dev/null
printf 'shoulder,time\n0,0\n1.4,2\n' >times.csv
# shellcheck disable=SC2086
"$OVOID_TOOL" robot path $cell --states times.csv --proofs -o hit.jsonl 2>/dev/null
number='[-+0-9.e]+'
for kind in free hit; do
    states=arm/path.csv
    [ $kind = hit ] && states=times.csv
    expect 0 "$kind" $kind.jsonl
    expect 0 "$kind with states" $kind.jsonl --states $states
    spoil $kind.jsonl
    alter 4 "$kind: margin" "s/\"margin\":$number/\"margin\":0.5/g" $kind.jsonl
    alter 4 "$kind: margin of the path" "2s/\"margin\":$number/\"margin\":0.001/" $kind.jsonl
    alter 4 "$kind: states" '2s/"q":\[\[-?[0-9]/"q":[[1/' $kind.jsonl --states $states
    alter 3 "$kind: states' count" '2s/"states":[0-9]+/"states":9/' $kind.jsonl
    alter 3 "$kind: steps' count" '2s/"steps":([0-9]+)/"steps":1\1/' $kind.jsonl
    alter 3 "$kind: cut off" "\$d" $kind.jsonl
    alter 3 "$kind: no step" '3d' $kind.jsonl
    alter 3 "$kind: path" '2s/"path":0/"path":1/' $kind.jsonl
    alter 3 "$kind: paths" 's/"paths":1/"paths":2/' $kind.jsonl
    alter 3 "$kind: digest" 's/"digest":"./"digest":"/' $kind.jsonl
    alter 3 "$kind: other digest" 's/"digest":"[0-9a-f]{4}/"digest":"0123/' $kind.jsonl
    alter 3 "$kind: variables" 's/"variables":\["shoulder","wrist"/"variables":["wrist","shoulder"/' $kind.jsonl
    alter 3 "$kind: pairs" '1s/"element":1/"element":2/' $kind.jsonl
    alter 3 "$kind: other shapes" 's/"parts":true/"parts":false/' $kind.jsonl
    alter 3 "$kind: no scene" 's/"scene":"[^"]*"/"scene":null/' $kind.jsonl
    alter 3 "$kind: no file" 's/"robot":"[^"]*"/"robot":"none.urdf"/' $kind.jsonl
    alter 3 "$kind: kind" '3s/"step":"[a-z]*"/"step":"near"/' $kind.jsonl
    alter 3 "$kind: keys" '2s/"looked_at"/"looked at"/' $kind.jsonl
    alter 3 "$kind: more" '2s/\}$/,"more":1}/' $kind.jsonl
    alter 3 "$kind: a pair twice in a step" '3s/"pairs":\[([0-9]+)/"pairs":[\1,\1/' $kind.jsonl
    alter 3 "$kind: form" 's/"path_proofs":2/"path_proofs":1/' $kind.jsonl
done
alter 3 "hit: no pair" '2s/"pair":[0-9]+,//' hit.jsonl
alter 3 "free: with a hit" '2s/"looked_at"/"hit_at":1,"looked_at"/' free.jsonl
# Steps that hold of states nearby prove nothing of those that were asked.
alter 4 "free: states nearby" '2s/"q":\[\[0,1.5,/"q":[[0,1.5000001,/' free.jsonl --states arm/path.csv
alter 0 "free: states nearby, not asked" '2s/"q":\[\[0,1.5,/"q":[[0,1.5000001,/' free.jsonl
alter 4 "free: less" '2s/"free_until":2/"free_until":1.5/' free.jsonl
alter 4 "free: more" '2s/"free_until":2/"free_until":2.5/' free.jsonl
alter 4 "hit: free" "2s/\"status\":\"hit\"(.*\"free_until\":$number,\"free_until_time\":$number),\"hit_at\".*,\"looked/\"status\":\"free\"\\1,\"looked/" hit.jsonl
alter 4 "hit: undecided, free until the end" "2s/\"status\":\"hit\"(.*\"free_until\":)$number,\"free_until_time\":$number,\"hit_at\".*,\"segment/\"status\":\"undecided\"\\11,\"free_until_time\":2,\"segment/" hit.jsonl
alter 4 "hit: later" "2s/\"hit_at\":$number/\"hit_at\":0.99/" hit.jsonl
alter 4 "hit: earlier" "2s/\"hit_at\":$number/\"hit_at\":0.1/" hit.jsonl
alter 4 "hit: beyond" "2s/\"hit_at\":$number/\"hit_at\":5/" hit.jsonl
# The claimed bracket must hold the one that is found: narrower, beside it, upside down and no number are refused, wider is
# true.
alter 4 "hit: raised lower end" "2s/\"lower\":$number/\"lower\":-5.66972344e-7/" hit.jsonl
alter 4 "hit: lowered upper end" "2s/\"upper\":$number/\"upper\":-5.66972344e-7/" hit.jsonl
alter 4 "hit: bracket below" "2s/\"lower\":$number,\"upper\":$number/\"lower\":-0.2,\"upper\":-0.1/" hit.jsonl
alter 4 "hit: bracket of a point" "2s/\"lower\":$number,\"upper\":$number/\"lower\":-5.66972344e-7,\"upper\":-5.66972344e-7/" hit.jsonl
alter 4 "hit: bracket upside down" "2s/\"lower\":$number,\"upper\":$number/\"lower\":0,\"upper\":-1/" hit.jsonl
alter 4 "hit: beyond the margin" "2s/\"upper\":$number/\"upper\":0.001/" hit.jsonl
alter 0 "hit: wider" "2s/\"lower\":$number,\"upper\":$number/\"lower\":-1,\"upper\":0/" hit.jsonl
printf 'shoulder,time\n0,0\n1.4,2\n1.4,3\n' >more.csv
expect 3 "hit: states left over" hit.jsonl --states more.csv
alter 4 "hit: free longer" "2s/\"free_until\":$number/\"free_until\":0.5683/" hit.jsonl
alter 4 "hit: time" "2s/\"hit_at_time\":$number/\"hit_at_time\":1/" hit.jsonl
alter 4 "hit: free time" "2s/\"free_until_time\":$number/\"free_until_time\":1.5/" hit.jsonl
alter 4 "hit: times" '2s/"times":\[0,2\]/"times":[0,3]/' hit.jsonl
alter 4 "hit: segment" '2s/"segment":0/"segment":1/' hit.jsonl
alter 4 "hit: pair" '2s/"pair":[0-9]+/"pair":0/' hit.jsonl
alter 4 "hit: sides" '2s/"upper","element":0/"hand","element":0/' hit.jsonl
alter 4 "hit: lower" "2s/\"lower\":$number/\"lower\":-1e-9/" hit.jsonl
alter 4 "hit: upper" "2s/\"upper\":$number,\"looked/\"upper\":-1,\"looked/" hit.jsonl
alter 4 "hit: upper, no hit" "2s/\"upper\":$number,\"looked/\"upper\":1,\"looked/" hit.jsonl
# The failing step is named with its line.
sed '5s/"end":[0-9.]*/"end":0.25/' hit.jsonl >altered.jsonl
"$OVOID_TOOL" verify altered.jsonl >out 2>&1
if grep -q "the steps of pair" out; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "FAILED no pair is named"; cat out; fi
line=$(grep -n '"normal"' hit.jsonl | head -1 | cut -d: -f1)
sed "${line}s/\"normal\":\\[[^]]*/\"normal\":[0,0,0/" hit.jsonl >altered.jsonl
"$OVOID_TOOL" verify altered.jsonl >out 2>&1
if grep -q "altered.jsonl:$line: step $((line - 3)): " out; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "FAILED line $line is not named"; cat out; fi
# Several files one after another; other folders.
cat free.jsonl hit.jsonl >both.jsonl
expect 0 "both" both.jsonl
sed 's/"robot":"[^"]*"/"robot":"gone.urdf"/; s/"srdf":"[^"]*"/"srdf":"gone.srdf"/; s/"scene":"[^"]*"/"scene":"gone.yaml"/' free.jsonl >moved.jsonl
expect 3 "moved" moved.jsonl
expect 0 "moved, given" moved.jsonl arm/arm.urdf --srdf arm/arm.srdf --scene arm/cell.yaml
expect 3 "another robot" free.jsonl arm/floats.urdf
expect 4 "other states" free.jsonl --states times.csv
echo "$passed passed, $failed failed, 0 skipped"
[ "$failed" -eq 0 ]
