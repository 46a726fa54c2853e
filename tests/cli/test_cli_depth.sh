#!/bin/sh
# Depths that fill the 512 points of a search's own memory, of even balls with one centre: no command ends with capacity,
# with proofs or without, and what is written is read and holds. Truth: the exact judge where the tool has it; the depth is
# that of two balls to their sagittas.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/need_tool.sh"
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
work=$OVOID_BUILD_DIR/test_cli_depth
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
LC_ALL=C
export LC_ALL

awk 'BEGIN { n = 900; for (i = 0; i < n; i++) {
    z = 2 * (i + 0.5) / n - 1; r = sqrt(1 - z * z); t = 2.399963229728653 * i
    printf "v %.17g %.17g %.17g\n", r * cos(t), r * sin(t), z } }' >ball.obj
turned="0 0 0 0.3 0.4 0.5 0.7"
"$OVOID_TOOL" distance ball.obj ball.obj --hull --pose-b "$turned" --json >one.jsonl 2>/dev/null
check 'distance: the bracket is narrow' grep -q '"status":"overlapping","limit":"none","lower":-1\.99' one.jsonl
check 'distance: the cover is large' [ "$(sed 's/.*"pairs":\[//;s/"triangles".*//' one.jsonl | tr -cd '[' | wc -c)" -gt 513 ]
"$OVOID_TOOL" verify one.jsonl ball.obj ball.obj --hull --pose-b "$turned" >said 2>&1
check 'distance: the cover holds' grep -q 'hold: 1, do not: 0' said
# A triangle less, and one turned over.
sed 's/"triangles":\[\[[0-9,]*\],/"triangles":[/' one.jsonl | "$OVOID_TOOL" verify - ball.obj ball.obj --hull --pose-b "$turned" >said 2>&1
check 'a hole is found' grep -q 'the surface is not closed' said
sed 's/"triangles":\[\[\([0-9]*\),\([0-9]*\),/"triangles":[[\2,\1,/' one.jsonl | "$OVOID_TOOL" verify - ball.obj ball.obj --hull --pose-b "$turned" >said 2>&1
check 'a triangle that is turned over is found' grep -q 'hold: 0, do not: 1' said

echo ball.obj >shapes.txt
echo 'a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz' >pairs.csv
echo '0,0,0,0,0,1,0,0,0,0,0,0,0.3,0.4,0.5,0.7' >>pairs.csv
for form in --csv --json; do
    "$OVOID_TOOL" batch --shapes shapes.txt --pairs pairs.csv --query distance $form >batch.out 2>said
    check "batch $form" grep -q 'overlapping.*none' batch.out
done
"$OVOID_TOOL" verify batch.out --shapes shapes.txt --pairs pairs.csv >said 2>&1
check 'batch: the cover holds' grep -q 'hold: 1, do not: 0' said

pose='"xyz":[0,0,0],"quat_wxyz":[0.3,0.4,0.5,0.7]'
printf '{"objects":[{"name":"a","mesh":"ball.obj","hull":true},{"name":"b","mesh":"ball.obj","hull":true,"pose":{%s}}]}' "$pose" >scene.json
for form in --csv --json; do
    "$OVOID_TOOL" check scene.json $form >check.out 2>said
    check "check $form" grep -q 'overlapping.*none' check.out
done
"$OVOID_TOOL" verify check.out scene.json >said 2>&1
check 'check: the cover holds' grep -q 'hold: 1, do not: 0' said
echo "$passed passed, $failed failed, 0 skipped"
[ $failed -eq 0 ]
