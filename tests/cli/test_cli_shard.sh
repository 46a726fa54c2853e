#!/bin/sh
# Shards and ovoid merge: for every N from 1 to 7 the merged bytes and the exit code are those of one run, of batch, check,
# run and robot check, in CSV and JSON Lines, with proofs. The file of a shard is one of ordinary results. A shard that is
# cut at any place, killed, or that met a full disk goes on and becomes the same files. What is missing, there twice, of
# another run, not finished or damaged is refused by name.
# Truth: the run without --shard.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/need_tool.sh"
# shellcheck source=tests/common/steps.sh
. "$(dirname "$0")/../common/steps.sh"
work=$OVOID_BUILD_DIR/test_cli_shard
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
LC_ALL=C
export LC_ALL
data=$OVOID_SOURCE_DIR/tests/cli/data

# ---- inputs: pairs with blank lines and CRLF, a scene with a floor that meets all, its motion, states of a robot

awk 'BEGIN { srand(3); n = 60
    print "a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz" >"pairs.csv"
    for (i = 0; i < 700; i++) {
        printf "%d,%d,0,0,0,1,0,0,0,%.9f,%.9f,%.9f,1,%.6f,0,0%s\n", i % 2, i % 3 % 2, 2 * rand(), 2 * rand(), rand(), rand(), i % 5 ? "" : "\r" >"pairs.csv"
        if (i % 50 == 0) print "" >"pairs.csv"
    }
    split("\"box\":[1,0.4,0.7]|\"cone\":{\"radius\":0.5,\"length\":1,\"sides\":7}|\"compound\":[{\"box\":[1,0.2,0.2]},{\"sphere\":0.3,\"pose\":{\"xyz\":[0.7,0,0]}}]", kind, "|")
    for (i = 0; i < n; i++) for (k = 0; k < 4; k++) p[i, k] = 4 * rand()
    print "time,body,x,y,z,qw,qx,qy,qz" >"moves.csv"
    for (f = 0; f < 5; f++)
        for (i = 0; i < n; i++) {
            if (i % 3 || !f) for (k = 0; k < 4; k++) p[i, k] += (rand() - 0.5) * 0.6
            if (i % 3) printf "%g,n%d,%.6f,%.6f,%.6f,1,%.6f,0.3,0\n", f / 4, i, p[i, 0], p[i, 1], p[i, 2], p[i, 3] >"moves.csv"
        }
    printf "{\"objects\":[{\"name\":\"floor\",\"box\":[9,9,1]}" >"scene.json"
    for (i = 0; i < n; i++)
        printf ",{\"name\":\"n%d\",%s,\"pose\":{\"xyz\":[%.6f,%.6f,%.6f],\"quat_wxyz\":[1,%.6f,0.3,0]}}", i, kind[i % 3 + 1], p[i, 0], p[i, 1], p[i, 2], p[i, 3] >"scene.json"
    print "],\"ignore\":[[\"n0\",\"n1\"],[\"n5\",\"n3\"]]}" >"scene.json"
    # Of many sizes, dense and thin, and some at one place.
    printf "{\"objects\":[{\"name\":\"floor\",\"box\":[9,9,1]}" >"cells.json"
    for (i = 0; i < 400; i++) {
        size = 0.1 + 2 * rand() ^ 8; far = i % 4 ? 3 : 9
        for (k = 0; k < 3; k++) p[i, k] = i % 40 ? far * rand() : 1
        printf ",{\"name\":\"n%d\",%s,\"pose\":{\"xyz\":[%.6f,%.6f,%.6f]}}", i, i % 3 ? sprintf("\"box\":[%.6f,0.2,0.1]", size) : sprintf("\"sphere\":%.6f", size / 2), p[i, 0], p[i, 1], p[i, 2] >"cells.json"
    }
    print "]}" >"cells.json"
    print "shoulder,wrist" >"states.csv"
    for (i = 0; i < 1900; i++) printf "%.6f,%.6f\n", 4.2 * rand() - 1.6, rand() >"states.csv" }'
printf '%s/cube.off\n%s/tetra.obj\n' "$data" "$data" >shapes.txt

robot="robot check $data/arm/arm.urdf --srdf $data/arm/arm.srdf --parts --scene $data/arm/cell.yaml --states states.csv"
has_robot=1
"$OVOID_TOOL" robot --help >/dev/null 2>&1 || has_robot=0

# all NUMBERS NAME WORDS...: N shards of a command, merged, are one run of it, for each of these N. The words have no blanks.
all() {
    numbers=$1 name=$2
    shift 2
    "$OVOID_TOOL" "$@" >one 2>/dev/null
    code=$?
    check "$name: one run" [ -s one ]
    for n in $numbers; do
        rm -f -- *.shard *.mark
        i=1
        while [ $i -le "$n" ]; do
            "$OVOID_TOOL" "$@" --shard "$i/$n" -o $i.shard --threads $((i % 3 + 1)) 2>/dev/null
            i=$((i + 1))
        done
        # In any order.
        # shellcheck disable=SC2046 # numbers
        "$OVOID_TOOL" merge $(printf '%s\n' *.shard | sort -r) >merged 2>said
        got=$?
        check "$name: the bytes of $n shards" cmp one merged
        check "$name: the exit code of $n shards, $got for $code" [ $got -eq $code ]
        # Each file begins as the results of one run do, and all lines are those.
        case " $* " in *' --csv '*) head=1 ;; *) head=0 ;; esac
        for file in *.shard; do tail -n +$((head + 1)) "$file"; done | sort >lines
        tail -n +$((head + 1)) one | sort >wanted
        case $name in *top*) ;; *) check "$name: the lines of $n shards" cmp wanted lines ;; esac
        check "$name: the first lines of $n shards" [ "$(for file in *.shard; do head -n $head "$file"; done | uniq)" = "$(head -n $head one)" ]
    done
}
every='1 2 3 4 5 6 7'
all 3 'batch, CSV' batch --shapes shapes.txt --pairs pairs.csv --csv
all "$every" 'batch, proofs' batch --shapes shapes.txt --pairs pairs.csv --csv --proofs --margin 0.5
all 3 'batch, JSON' batch --shapes shapes.txt --pairs pairs.csv --json --query collide
all 3 'check' check scene.json --csv --proofs
all "$every" 'check, margin' check scene.json --margin 0.3 --json
all '2 5' 'check, cells' check cells.json --margin 0.02 --csv
all 9 'check, cells, wide' check cells.json --margin 0.4 --csv
all 4 'check, top' check scene.json --top 50 --csv
all 3 'run' run scene.json --motion moves.csv --margin 0.2 --json
all "$every" 'run, continuous' run scene.json --motion moves.csv --query collide --continuous --csv --proofs

# Many frames, so that parts have several blocks. A body whose allowance is sideways alone has another over it, which
# slides over its edge: along the normal of the first frames it is farther than 0.299, and a new query leaves that open.
awk 'BEGIN { srand(5)
    printf "{\"objects\":[{\"name\":\"wide\",\"box\":[1,1,1],\"allowance\":{\"outside\":0.1,\"inside\":0,\"axis\":[0,0,1]}}," >"long.json"
    printf "{\"name\":\"over\",\"box\":[0.2,0.2,0.2],\"pose\":{\"xyz\":[0,0,0.9]}},{\"name\":\"beside\",\"sphere\":0.5,\"pose\":{\"xyz\":[0,2,0]}}," >"long.json"
    print "{\"name\":\"rare\",\"cylinder\":{\"radius\":0.3,\"length\":1},\"pose\":{\"xyz\":[0,-1.1,0]}}]}" >"long.json"
    print "time,body,x,y,z,qw,qx,qy,qz" >"long.csv"
    print "time,body,vx,vy,vz,wx,wy,wz" >"speeds.csv"
    for (f = 0; f < 150; f++) {
        printf "%g,over,%.6f,0,0.9,1,0,0,0\n%g,beside,0.1,%.6f,0,1,0,0,0\n", f / 10, f * 0.005, f / 10, 1.3 + 0.2 * rand() >"long.csv"
        if (f % 40 == 17) printf "%g,rare,0.2,%.6f,0,1,0,0,%.4f\n", f / 10, -1.1 - (f == 17 ? 1.5 : 0.1 * rand()), rand() >"long.csv"
        printf "%g,over,0.05,%.6f,0,0,0,1\n", f / 10, 0.01 * rand() >"speeds.csv"
        if (f % 40 == 17) printf "%g,rare,0.01,%.6f,0,0.1,0,0\n", f / 10, 0.1 - 0.2 * rand() >"speeds.csv"
    } }'
all '1 2 9' 'run, many frames' run long.json --motion long.csv --margin 0.299 --csv
all 2 'run, many frames, no margin' run long.json --motion long.csv --csv
all '2 5' 'run, many frames, continuous' run long.json --motion long.csv --margin 0.299 --continuous --json
all '2 3' 'run, velocities' run long.json --motion speeds.csv --margin 0.299 --continuous --csv
"$OVOID_TOOL" run long.json --motion long.csv --margin 0.299 --csv 2>/dev/null | grep ',over,' >lines
check 'a pair that is proven farther is not listed, and listed once it is not' [ "$(head -1 lines | cut -d, -f 1 | cut -d. -f 1)" -gt 3 ]
# Frames of other parts are not read; what is wrong in them is said by their part.
sed '250s/,[^,]*$/,x/' long.csv >bad.csv
for i in 1 2 3; do
    rm -f $i.bad*
    "$OVOID_TOOL" run long.json --motion bad.csv --margin 0.299 --csv --shard $i/3 -o $i.bad 2>said
    code=$?
    if [ $i -eq 3 ]; then
        check "a bad line is of part 3: said" grep -q 'bad.csv:250: column qz: "x' said
        check "a bad line is of part 3: exit code $code" [ $code -eq 3 ]
    else
        check "a bad line is not of part $i: exit code $code" [ $code -ne 3 ]
    fi
done
sed '250s/,[a-z]*,/,none,/' long.csv >bad.csv
"$OVOID_TOOL" run long.json --motion bad.csv --margin 0.299 --csv --shard 9/9 -o 9.none 2>said
check 'a name of no body before a part' [ $? -eq 3 ]
check 'a name of no body before a part: said' grep -q 'bad.csv:250: the scene has no object "none"' said
sed '250s/^/-/' long.csv >bad.csv
"$OVOID_TOOL" run long.json --motion bad.csv --margin 0.299 --csv --shard 1/9 -o 1.none 2>said
check 'a time that goes back behind a part' [ $? -eq 3 ]
check 'a time that goes back behind a part: said' grep -q 'bad.csv:250: the time is before' said
rm -f -- *.bad* *.none*

# Searches for depths that fill their memory go farther where proofs are written.
cat >sizes.json <<'END'
{"objects":[{"box":[7.889982050451218,7.889982050451218,7.889982050451218],"name":"o3","pose":{"xyz":[0.6578745853158191,1.6636244539173282,-1.4239153689754074],"quat_wxyz":[-0.365606394624974,0.29705377546415784,0.6138572478257066,-1.0134762399299608]},"radius":0.7889982050451219,"allowance":{"outside":0.07889982050451218,"inside":0.15779964100902436}},
{"cone":{"radius":1710456.2801992295,"length":1925053.9772578424},"name":"o4","pose":{"xyz":[-1.1988030346456733,-0.660747291736653,-0.5532017374487067]}},
{"compound":[{"cylinder":{"radius":0.006434138572451362,"length":0.0059868708186269545},"pose":{"xyz":[0.008373588967579025,0.0029312496154726953,0.005470708951596489],"rpy":[0,0.14772306054947837,0.7789843224117946]}},
{"ellipsoid":{"half_axes":[0.004454294976041548,0.0075086952028367935,0.0075086952028367935]},"pose":{"xyz":[0.007464013673564487,-0.004358867568950675,0.006779822007013957],"rpy":[0,1.5707963267948966,0.8121166315317105]}}],"name":"o11","pose":{"xyz":[-0.17689229955010297,0.025003510611431492,2.0624542532377443],"rpy":[1.5707963267948966,1.5707963267948966,1.5707963267948966]}}]}
END
all 2 'check, bodies of sizes far apart' check sizes.json --json

# packed NAME SCENE COMMAND WORDS...: one run of a packed scene, and its shards, are one run of the scene.
"$OVOID_TOOL" pack scene.json -o scene.ovoids 2>/dev/null
"$OVOID_TOOL" pack cells.json -o cells.ovoids 2>/dev/null
packed() {
    name=$1 scene=$2 command=$3
    shift 3
    "$OVOID_TOOL" "$command" "$scene.json" "$@" >of_json 2>/dev/null
    code=$?
    "$OVOID_TOOL" "$command" "$scene.ovoids" "$@" >of_packed 2>/dev/null
    got=$?
    check "$name: the exit code of a packed scene, $got for $code" [ $got -eq $code ]
    check "$name: the bytes of a packed scene" cmp of_json of_packed
    all '2 4' "$name, packed" "$command" "$scene.ovoids" "$@"
    check "$name: shards of a packed scene" cmp of_json merged
}
packed 'check, margin' scene check --margin 0.3 --json
check 'proofs of a packed scene' "$OVOID_TOOL" verify of_packed scene.ovoids
packed 'check, cells' cells check --margin 0.02 --csv
packed 'check' scene check --csv --proofs
packed 'run' scene run --motion moves.csv --margin 0.2 --continuous --csv --proofs
rm -f -- *.shard *.mark
"$OVOID_TOOL" check scene.json --margin 0.3 --json --shard 1/2 -o 1.shard 2>/dev/null
"$OVOID_TOOL" check scene.ovoids --margin 0.3 --json --shard 2/2 -o 2.shard 2>/dev/null
"$OVOID_TOOL" merge 1.shard 2.shard >merged 2>said
check 'shards of a scene and of its packed one are none of one run' grep -q 'of inputs with the digest' said
# shellcheck disable=SC2086 # words without blanks
if [ $has_robot -eq 1 ]; then
    all 3 'robot check' $robot --csv
    all "$every" 'robot check, near' $robot --json --near 0.3 --gradient --top 1000
fi
printf 'a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz\n0,1,0,0,0,1,0,0,0,3,0,0,1,0,0,0' >few.csv
all 5 'one pair, no line end' batch --shapes shapes.txt --pairs few.csv --csv
head -1 few.csv >none.csv
all 2 'no pair' batch --shapes shapes.txt --pairs none.csv --csv

# Names that CSV and JSON write otherwise than they are, bodies at equal distances, and infinite bounds.
printf '{"objects":[{"name":"a, \\"b\\"}","sphere":1},{"name":"=z\\n","sphere":1,"pose":{"xyz":[4,0,0]}},{"name":"\\\\{","sphere":1,"pose":{"xyz":[8,0,0]}},' >names.json
printf '{"name":"a","sphere":1,"pose":{"xyz":[12,0,0]}},{"name":"q\\",","sphere":1,"pose":{"xyz":[20,0,0]}},{"name":"B","box":[1,1,1],"pose":{"xyz":[16,0,0]}}]}' >>names.json
all '1 3 9' 'names, CSV' check names.json --csv --proofs
all '2 4' 'names, JSON' check names.json --json

# ---- proofs are kept, in the shards and in what is merged from them

rm -f -- *.shard *.mark
for i in 1 2 3; do "$OVOID_TOOL" run scene.json --motion moves.csv --margin 0.2 --continuous --json --shard $i/3 -o $i.shard 2>/dev/null; done
for i in 1 2 3; do
    "$OVOID_TOOL" verify $i.shard scene.json --motion moves.csv --partial >/dev/null 2>&1
    check "the proofs of shard $i" [ $? -eq 0 ]
    "$OVOID_TOOL" batch --shapes shapes.txt --pairs pairs.csv --json --shard $i/3 -o $i.jsonl 2>/dev/null
    "$OVOID_TOOL" verify $i.jsonl --shapes shapes.txt --pairs pairs.csv --shard $i/3 >said 2>&1
    check "the proofs of part $i of a batch; got $(cat said)" grep -q 'do not: 0; undecided answers: 0; checked' said
    "$OVOID_TOOL" verify $i.jsonl --shapes shapes.txt --pairs pairs.csv --shard $((i % 3 + 1))/3 >/dev/null 2>&1
    check "part $i is no other one" [ $? -ne 0 ]
done
"$OVOID_TOOL" merge ./*.shard -o merged.jsonl 2>/dev/null
"$OVOID_TOOL" verify merged.jsonl scene.json --motion moves.csv --partial >/dev/null 2>&1
check 'the proofs of merged lines' [ $? -eq 0 ]

# ---- interrupted: cut at many places, between and within pieces, and a byte altered behind them

# goes_on NAME WORDS...: shard 2/2 goes on from what is there and is whole again, and so is its mark.
goes_on() {
    place=$1
    shift
    "$OVOID_TOOL" "$@" --shard 2/2 -o part.shard 2>said
    got=$?
    check "$place" cmp whole.shard part.shard
    check "$place: the mark" cmp whole.shard.mark part.shard.mark
}

# again NAME WORDS...: as goes_on, from many places.
again() {
    name=$1
    shift
    rm -f whole.shard* part.shard*
    "$OVOID_TOOL" "$@" --shard 2/2 -o whole.shard 2>/dev/null
    code=$?
    size=$(wc -c <whole.shard)
    for step in 0 1 90 400 620 950 999; do
        cut=$((size * step / 1000))
        head -c $cut whole.shard >part.shard
        cp whole.shard.mark part.shard.mark
        goes_on "$name: cut at $cut of $size bytes" "$@"
    done
    # The mark cut within and between its lines, as by kill -9: the results are ahead of it.
    begin=$(grep -c -v -E '^(kept|done): ' whole.shard.mark)
    lines=$(wc -l <whole.shard.mark)
    for line in $begin $((begin + 1)) $(((begin + lines) / 2)) $((lines - 1)); do
        cp whole.shard part.shard
        head -n "$line" whole.shard.mark >part.shard.mark
        goes_on "$name: the mark cut behind line $line" "$@"
        { head -n "$line" whole.shard.mark && printf 'kept: 70'; } >part.shard.mark
        goes_on "$name: the mark cut within line $((line + 1))" "$@"
    done
    # A torn end of other bytes, as after a loss of power, longer than what is to come; and one byte within.
    { head -c $((size / 2)) whole.shard && head -c "$size" /dev/zero; } >part.shard
    cp whole.shard.mark part.shard.mark
    goes_on "$name: a torn end" "$@"
    { head -c $((size / 2)) whole.shard && printf '\377' && tail -c +$((size / 2 + 2)) whole.shard; } >part.shard
    goes_on "$name: a byte within" "$@"
    sed "$((lines - 1))s/ [0-9]* units/ 7 units/" whole.shard.mark >part.shard.mark
    goes_on "$name: a number within the mark" "$@"
    { cat whole.shard && echo more; } >part.shard
    goes_on "$name: bytes behind the end" "$@"
    goes_on "$name: a whole shard stays" "$@"
    check "$name: the exit code of a whole shard, $got for $code" [ "$got" -eq $code ]
    rm part.shard
    goes_on "$name: the results are lost, the mark is not" "$@"
}
again batch batch --shapes shapes.txt --pairs pairs.csv --json
again check check scene.json --json
again 'check, CSV' check scene.json --csv
again run run scene.json --motion moves.csv --json
again 'run, continuous' run scene.json --motion moves.csv --json --continuous --margin 0.1
again 'run, many frames' run long.json --motion long.csv --csv --continuous --margin 0.299
# shellcheck disable=SC2086 # words without blanks
[ $has_robot -eq 0 ] || again 'robot check' $robot --json --near 0.3

# kill -9 at whatever place the run has come to.
rm -f whole.shard* part.shard*
for i in 1 2 3 4 5 6 7 8 9; do tail -n +2 pairs.csv | grep ,; done >>pairs.csv.body
{ head -1 pairs.csv && cat pairs.csv.body; } >many.csv
"$OVOID_TOOL" batch --shapes shapes.txt --pairs many.csv --json --shard 1/1 -o whole.shard 2>/dev/null
"$OVOID_TOOL" batch --shapes shapes.txt --pairs many.csv --json --shard 1/1 -o part.shard >/dev/null 2>&1 &
while [ ! -s part.shard ] && kill -0 $! 2>/dev/null; do :; done
kill -9 $! 2>/dev/null
wait $! 2>/dev/null
"$OVOID_TOOL" batch --shapes shapes.txt --pairs many.csv --json --shard 1/1 -o part.shard 2>/dev/null
check 'killed' cmp whole.shard part.shard
check 'killed: the mark' cmp whole.shard.mark part.shard.mark

# Two runs of the same shard: the second one ends at once, and changes nothing.
"$OVOID_TOOL" batch --shapes shapes.txt --pairs many.csv --json --shard 1/1 -o lock.shard >/dev/null 2>&1 &
while [ ! -s lock.shard.mark ] && kill -0 $! 2>/dev/null; do :; done
if kill -STOP $! 2>/dev/null && ! grep -q '^done' lock.shard.mark; then
    "$OVOID_TOOL" batch --shapes shapes.txt --pairs many.csv --json --shard 1/1 -o lock.shard 2>said
    check 'two runs: said' grep -q 'lock.shard: another run is writing this shard' said
fi
kill -CONT $! 2>/dev/null
wait $! 2>/dev/null
check 'two runs: the first one' cmp whole.shard lock.shard

# A full disk: a limit of 100 blocks of 512 or 1024 bytes.
rm -f part.shard*
(ulimit -f 100 && "$OVOID_TOOL" batch --shapes shapes.txt --pairs many.csv --json --shard 1/1 -o part.shard) >/dev/null 2>said
check 'a full disk: the code' [ $? -eq 3 ]
check 'a full disk: what is said' grep -q 'part.shard: could not be written in full' said
check 'a full disk: what is there stays' [ -s part.shard ]
"$OVOID_TOOL" merge part.shard >merged 2>said
check 'not finished' grep -q 'part 1/1 is not finished' said
check 'not finished: nothing is written' [ ! -s merged ]
"$OVOID_TOOL" batch --shapes shapes.txt --pairs many.csv --json --shard 1/1 -o part.shard 2>/dev/null
check 'a full disk: goes on' cmp whole.shard part.shard
(ulimit -f 100 && "$OVOID_TOOL" merge whole.shard -o merged.jsonl2) >/dev/null 2>&1
check 'a full disk of merge' [ $? -eq 3 ]
check 'a full disk of merge: no file' [ ! -e merged.jsonl2 ]

# ---- refused, by name

# refuse WORDS TEXT...: merge of the shards says the text, with code 3, and writes nothing.
refuse() {
    text=$1
    shift
    "$OVOID_TOOL" merge "$@" >merged 2>said
    got=$?
    check "refused: $text; got $(cat said)" grep -q -- "$text" said
    check "refused: $text: the code" [ $got -eq 3 ]
}
# copy FROM TO: a shard, with its mark.
copy() { cp "$1" "$2" && cp "$1.mark" "$2.mark"; }
shard() { "$OVOID_TOOL" batch --shapes shapes.txt --pairs pairs.csv --csv "$@" 2>/dev/null; }
rm -f -- *.shard *.mark
for i in 1 2 3; do shard --shard $i/3 -o $i.shard; done
copy 2.shard twin.shard
shard --shard 1/4 -o four.shard
shard --shard 1/3 --margin 0.25 -o margin.shard
shard --shard 1/3 --proofs -o proofs.shard
"$OVOID_TOOL" batch --shapes shapes.txt --pairs pairs.csv --json --shard 1/3 -o json.shard 2>/dev/null
"$OVOID_TOOL" check scene.json --csv --shard 1/3 -o check.shard 2>/dev/null
sed 's/^0,0,/0,1,/' pairs.csv >pairs2.csv
"$OVOID_TOOL" batch --shapes shapes.txt --pairs pairs2.csv --csv --shard 1/3 -o pairs.shard 2>/dev/null
# One digit of the last pair, far behind the beginning.
sed '$s/^\([0-9],[0-9],\)0,/\11,/' pairs.csv >pairs3.csv
cmp -s pairs.csv pairs3.csv && echo 'FAILED: the pairs are not altered' && failed=$((failed + 1))
"$OVOID_TOOL" batch --shapes shapes.txt --pairs pairs3.csv --csv --shard 1/3 -o late.shard 2>/dev/null
# The list stays the same, and a mesh that it names does not.
printf '%s/cube.off\nmesh.obj\n' "$data" >shapes3.txt
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n' >mesh.obj
"$OVOID_TOOL" batch --shapes shapes3.txt --pairs pairs.csv --csv --shard 1/3 -o mesh1.shard 2>/dev/null
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 2\n' >mesh.obj
"$OVOID_TOOL" batch --shapes shapes3.txt --pairs pairs.csv --csv --shard 2/3 -o mesh2.shard 2>/dev/null
refuse 'a shard is missing: part 2/3' 1.shard 3.shard
refuse 'shards are missing: parts 1/3, 3/3' 2.shard
refuse '2.shard and twin.shard are both part 2/3' 1.shard twin.shard 2.shard 3.shard
refuse 'four.shard: is part 1/4, and 3.shard part 3/3' 3.shard 2.shard four.shard
refuse 'margin.shard: is with the options --margin=0.25, and 2.shard --margin=-1' 2.shard margin.shard 3.shard
refuse 'proofs.shard: is with the options --proofs=1, and 2.shard --proofs=0' 2.shard proofs.shard 3.shard
refuse 'json.shard: is in the format json, and 2.shard csv' 2.shard json.shard 3.shard
refuse 'check.shard: is of the command check, and 2.shard batch' 2.shard check.shard 3.shard
refuse 'pairs.shard: is of inputs with the digest .*, and 2.shard' 2.shard pairs.shard 3.shard
refuse 'late.shard: is of inputs with the digest .*, and 2.shard' 2.shard late.shard 3.shard
refuse 'mesh2.shard: is of inputs with the digest .*, and mesh1.shard' mesh1.shard mesh2.shard
refuse 'pairs.csv: is no shard' 1.shard pairs.csv
refuse 'nowhere.shard: cannot be opened' nowhere.shard
cp 2.shard alone.shard
refuse 'alone.shard: is no shard, as .*: its mark, alone.shard.mark, is not there' 1.shard alone.shard
head -n 5 2.shard.mark >alone.shard.mark
refuse 'alone.shard.mark, is no mark of a shard' 1.shard alone.shard
sed 's/^objects .*/objects 4000000000/' 2.shard.mark >alone.shard.mark
refuse 'alone.shard.mark, is no mark of a shard' 1.shard alone.shard
sed '$d' 2.shard.mark >alone.shard.mark
refuse 'alone.shard: part 2/3 is not finished, or damaged; run it again, with --shard 2/3: it goes on' 1.shard alone.shard 3.shard
# A pipe in the place of a shard or of its mark is refused at once, without waiting for a writer.
mkfifo pipe.shard
timeout 10 "$OVOID_TOOL" merge 1.shard pipe.shard 3.shard >merged 2>said
check "a pipe for a shard; got $(cat said)" grep -q 'pipe.shard: cannot be opened: it is no regular file' said
cp 2.shard queue.shard && mkfifo queue.shard.mark
timeout 10 "$OVOID_TOOL" merge 1.shard queue.shard 3.shard >merged 2>said
check "a pipe for a mark; got $(cat said)" grep -q 'queue.shard.mark, is no mark of a shard' said
rm pipe.shard queue.shard.mark
# The marks of the shards are inputs, too.
cp 2.shard.mark before
"$OVOID_TOOL" merge 1.shard 2.shard 3.shard -o ./2.shard.mark 2>said
check 'a mark is not overwritten: the code' [ $? -eq 2 ]
check 'a mark is not overwritten' cmp before 2.shard.mark
check 'a mark is not overwritten: said' grep -q 'would overwrite the mark of its own input 2.shard' said
# Altered bytes: in all pieces of the results, and in the mark.
for file in altered.shard altered.shard.mark; do
    copy 2.shard altered.shard
    cp $file whole
    size=$(wc -c <$file)
    at=40
    while [ $at -lt "$size" ]; do
        { head -c $at whole && printf '\377' && tail -c +$((at + 2)) whole; } >$file
        "$OVOID_TOOL" merge 1.shard altered.shard 3.shard >merged 2>said
        check "$file: altered at byte $at" [ $? -eq 3 ]
        check "$file: altered at byte $at: its name" grep -q altered.shard said
        at=$((at + size / 11))
    done
done
# What stands behind the end of either file; and a part whose mark was made that of another one.
copy 2.shard altered.shard
echo >>altered.shard
refuse 'altered.shard: part 2/3 is not finished, or damaged' 1.shard altered.shard 3.shard
copy 2.shard altered.shard
tail -n 1 2.shard.mark >>altered.shard.mark
refuse 'altered.shard: part 2/3 is not finished, or damaged' 1.shard altered.shard 3.shard
"$OVOID_TOOL" check scene.json --csv --shard 1/2 -o half.shard 2>/dev/null
cp half.shard same.shard
sed '1,20s,^part 1/2,part 2/2,' half.shard.mark >same.shard.mark
refuse 'same.shard: part 2/2 is not finished, or damaged' half.shard same.shard
# What is at the place of a shard and is none, or another one, stays.
shard --shard 2/3 -o pairs3.csv
cp pairs.csv plain && "$OVOID_TOOL" batch --shapes shapes.txt --pairs pairs.csv --csv --shard 2/3 -o plain 2>said
check 'no shard is overwritten' cmp plain pairs.csv
check 'no shard is overwritten: said' grep -q 'plain: is there and is no shard' said
cp pairs.csv free.mark && "$OVOID_TOOL" batch --shapes shapes.txt --pairs pairs.csv --csv --shard 2/3 -o free 2>said
check 'no mark is overwritten' cmp free.mark pairs.csv
check 'no mark is overwritten: said' grep -q 'free.mark: is there and is no mark of a shard' said
copy 2.shard other.shard && "$OVOID_TOOL" batch --shapes shapes.txt --pairs pairs.csv --csv --shard 3/3 -o other.shard 2>said
check 'another part stays' cmp 2.shard other.shard
check 'another part stays: said' grep -q 'other.shard: is part 2/3, not 3/3' said
"$OVOID_TOOL" batch --shapes shapes.txt --pairs pairs.csv --csv --margin 1 --shard 2/3 -o other.shard 2>said
check 'other options stay: said' grep -q 'other.shard: is with the options --margin=-1, and this run --margin=1' said
# A bad line has its number in the whole file.
{ cat pairs.csv && echo '0,9,0,0,0,1,0,0,0,3,0,0,1,0,0,0'; } >bad.csv
lines=$(wc -l <bad.csv)
"$OVOID_TOOL" batch --shapes shapes.txt --pairs bad.csv --csv --shard 3/3 -o bad.shard 2>said
check 'a bad line' [ $? -eq 3 ]
check "a bad line: number $lines" grep -q "bad.csv:$lines: column b" said

echo "$passed passed, $failed failed, 0 skipped"
[ $failed -eq 0 ]
