#!/bin/sh
# The tool when things end badly: a full disk, readers that go away, signals in the middle, streams that are closed, little
# memory. Truth: the exit code and the message are what docs/tool.md promises, no unfinished file stays, and a file that was
# there before is as it was.
set -u
# shellcheck source=tests/cli/need_tool.sh
. "$(dirname "$0")/need_tool.sh"
work=$OVOID_BUILD_DIR/test_cli_hostile
rm -rf "$work" && cp -R "$OVOID_SOURCE_DIR/tests/cli/data" "$work" && cd "$work" || exit 1
passed=0 failed=0 skipped=0
LC_ALL=C
export LC_ALL

pass() { passed=$((passed + 1)); }
fail() {
    failed=$((failed + 1))
    echo "FAILED $1"
}

# A batch of many pairs, a scene of many bodies, a mesh of many points: each takes a while.
awk 'NR == 1; NR > 1 { for (i = 0; i < 3000; i++) print }' pairs.csv >many.csv
awk 'BEGIN { printf "{\"objects\":["
    for (i = 0; i < 1500; i++) printf "%s{\"name\":\"n%d\",\"box\":[1,1,1],\"pose\":{\"xyz\":[%d,%d,%d]}}", i ? "," : "", i, i % 12, i / 12 % 12, i / 144
    print "]}" }' >many.json
awk 'BEGIN { srand(1)
    for (i = 0; i < 40000; i++) { x = rand() - 0.5; y = rand() - 0.5; z = rand() - 0.5; r = sqrt(x * x + y * y + z * z)
        printf "v %.9g %.9g %.9g\n", x / r, y / r, z / r } }' >many.obj
awk 'BEGIN { print "time,body,x,y,z,qw,qx,qy,qz"; for (i = 0; i < 3000; i++) printf "%d,n%d,%d,%g,0,1,0,0,0.1\n", i / 2, i % 1500, i % 12, i / 200 }' >moves.csv
awk 'BEGIN { print "time,body,x,y,z,qw,qx,qy,qz"; for (i = 0; i < 900; i++) printf "%d,tee,0,0,%g,1,0,0,0\n", i, 1 + i % 3 / 10 }' >long_fall.csv
"$OVOID_TOOL" batch --shapes shapes.txt --pairs many.csv --json -o many.jsonl 2>/dev/null

# clean NAME: no unfinished file, no results under the final names, what was there as it was.
clean() {
    left=$(find . -name '*.tmp' -o -name 'new.*')
    if [ -z "$left" ] && [ "$(cat old.out)" = old ]; then
        pass
    else
        fail "$1: left behind: $left, old.out: $(head -c 100 old.out)"
        find . \( -name '*.tmp' -o -name 'new.*' \) -exec rm {} +
    fi
    echo old >old.out
}
echo old >old.out

# expect NAME CODE PHRASE: what the command that just ran (its code in $code, its words in `err`) must have said. An empty
# phrase: nothing at all.
expect() {
    if [ -n "$3" ]; then grep -q "$3" err; else [ ! -s err ]; fi
    said=$?
    if [ "$code" -eq "$2" ] && [ $said -eq 0 ]; then
        pass
    else
        fail "$1: exit $code, not $2; said: $(head -c 300 err)"
    fi
}

# ---- a disk that is full after 8 blocks: by a limit on the size of files, whose signal is ignored or not

for ignored in XFSZ ''; do
    for target in new.out old.out; do
        for run in "batch --shapes shapes.txt --pairs many.csv --json -o $target" \
            "batch --shapes shapes.txt --pairs many.csv -o $target" "check many.json --margin 1 --csv -o $target" \
            "run many.json --motion moves.csv --margin 0.1 --continuous --json -o $target" \
            "run moving.json --motion long_fall.csv --query collide --plot $target" "view scene.json -o $target"; do
            (
                if [ -n "$ignored" ]; then trap '' "$ignored"; fi
                ulimit -f 8
                # shellcheck disable=SC2086 # a command line
                exec "$OVOID_TOOL" $run
            ) >/dev/null 2>err
            code=$?
            expect "full disk ($ignored), $run" 3 'could not be written'
            clean "full disk ($ignored), $run"
        done
    done
    (
        ulimit -f 1
        exec "$OVOID_TOOL" fit --table many.obj -o new.ovoid
    ) >/dev/null 2>err
    code=$?
    expect "full disk ($ignored), fit" 3 'could not be written'
    clean "full disk ($ignored), fit"
done

# ---- a small disk, where one may be made

mkdir -p small
if mount -t tmpfs -o size=64k none small 2>/dev/null; then
    "$OVOID_TOOL" batch --shapes shapes.txt --pairs many.csv --json -o small/new.out 2>err
    code=$?
    expect 'small disk, batch' 3 'No space left\|is the disk full'
    "$OVOID_TOOL" fit many.obj -o small/new.ovoid >/dev/null 2>err
    code=$?
    expect 'small disk, fit' 3 'No space left\|is the disk full'
    if [ -z "$(ls -A small)" ]; then pass; else fail "small disk: left behind: $(ls -A small)"; fi
    umount small
else
    skipped=$((skipped + 1))
    echo 'skipped: no small disk can be made here'
fi

# ---- readers that go away: no word, exit code 141

mkfifo unread.fifo
for run in "batch --shapes shapes.txt --pairs many.csv --json" "batch --shapes shapes.txt --pairs many.csv --csv" \
    "batch --shapes shapes.txt --pairs many.csv" "check many.json --margin 0.5 --json" "check many.json --margin 0.5" \
    "run many.json --motion moves.csv --margin 0.5 --json" "run many.json --motion moves.csv --csv" \
    "fit --json $(for i in 1 2 3 4 5 6 7 8; do printf 'cube.off tetra.obj parts.obj square.off ' && : "$i"; done)" \
    "view scene.json" "check --help"; do
    # A pipe that nobody reads any more: descriptor 5, after 4 was closed.
    # shellcheck disable=SC2086,SC2094 # a command line; a pipe
    (exec 4<>unread.fifo 5>unread.fifo && exec 4<&- && exec "$OVOID_TOOL" $run >&5) 2>err
    code=$?
    sed -i '/ms$\|objects in\|pairs in/d' err # notes with counts are none of our matter
    expect "closed pipe, $run" 141 ''
done

# ---- signals: 128 and their number, nothing left behind. env gives a command of the background the signals of a new
# program; a shell has some ignored there.

code_of() { case $1 in INT) echo 130 ;; TERM) echo 143 ;; HUP) echo 129 ;; QUIT) echo 131 ;; USR1) echo 138 ;; XCPU) echo 152 ;; esac; }

# interrupt NAME INPUT COMMAND...: all of these signals while the command waits for more of its standard input: all of it was
# read but what a pipe holds, and the end does not come.
interrupt() {
    name=$1 input=$2
    shift 2
    for signal in INT TERM HUP QUIT USR1 XCPU; do
        env --default-signal "$@" <input.fifo >/dev/null 2>err &
        exec 3>input.fifo
        cat "$input" >&3
        kill -s "$signal" $!
        wait $! 2>/dev/null
        code=$?
        exec 3>&-
        if [ "$code" -eq "$(code_of "$signal")" ] && ! grep -q 'error\|Sanitizer' err; then
            pass
        else
            fail "$name, SIG$signal: exit $code; said: $(head -c 300 err)"
        fi
        clean "$name, SIG$signal"
    done
}

# interrupt_at PATTERN NAME COMMAND...: all of these signals as soon as there is a file of that name; a command that is done
# before it hears of them must have done all.
interrupt_at() {
    pattern=$1 name=$2
    shift 2
    for signal in INT TERM HUP QUIT USR1 XCPU; do
        rm -f pid code
        (
            env --default-signal "$@" </dev/null >/dev/null 2>err &
            echo $! >pid.new && mv pid.new pid
            wait $! 2>/dev/null
            echo $? >code.new && mv code.new code
        ) &
        until [ -e pid ] && { [ -e code ] || [ -n "$(find . -name "$pattern")" ]; }; do sleep 0.01; done
        kill -s "$signal" "$(cat pid)" 2>/dev/null
        wait 2>/dev/null
        code=$(cat code)
        if [ "$code" -eq "$(code_of "$signal")" ] && ! grep -q 'error\|Sanitizer' err; then
            pass
        elif [ "$code" -le 1 ]; then
            pass && echo "$name: done before SIG$signal came" && rm -f new.out && echo old >old.out
        else
            fail "$name, SIG$signal: exit $code; said: $(head -c 300 err)"
        fi
        clean "$name, SIG$signal"
    done
}

if env --default-signal true 2>/dev/null && command -v timeout >/dev/null; then
    mkfifo input.fifo
    interrupt 'batch to a new file' many.csv "$OVOID_TOOL" batch --shapes shapes.txt --pairs - --json -o new.out
    interrupt 'batch over a file' many.csv "$OVOID_TOOL" batch --shapes shapes.txt --pairs - --threads 3 --csv -o old.out
    interrupt 'batch, a table' many.csv "$OVOID_TOOL" batch --shapes shapes.txt --pairs - --threads 1 -o new.out
    interrupt 'verify' many.jsonl "$OVOID_TOOL" verify - --shapes shapes.txt --pairs many.csv
    interrupt_at '*.tmp' 'check' "$OVOID_TOOL" check many.json --json -o new.out
    interrupt_at '*.tmp' 'check over a file' "$OVOID_TOOL" check many.json --json -o old.out
    interrupt 'run to a new file' moves.csv "$OVOID_TOOL" run many.json --motion - --margin 0.5 --json -o new.out
    interrupt 'run over a file' moves.csv "$OVOID_TOOL" run many.json --motion - --margin 0.5 --continuous -o old.out
    # fit makes one whole file after another.
    mkdir made
    interrupt_at 'many*.ovoid' 'fit' "$OVOID_TOOL" fit --gap 1e-15 -o made/ many.obj many.obj many.obj many.obj many.obj
    for file in made/*; do
        if [ ! -e "$file" ] || "$OVOID_TOOL" fit "$file" >/dev/null 2>&1; then pass; else fail "fit left $file"; fi
    done
    # Whatever the moment: by a clock, and any of the ends is right.
    for after in 0.01 0.02 0.03 0.05 0.07 0.1 0.15 0.2 0.3; do
        timeout --preserve-status -s INT $after "$OVOID_TOOL" batch --shapes shapes.txt --pairs many.csv --json -o old.out \
            >/dev/null 2>err
        code=$?
        # What was there before, or, where it was done by then, all of the new.
        if [ $code -eq 130 ] && [ "$(head -c 100 old.out)" = old ]; then
            pass
        elif { [ $code -eq 130 ] || [ $code -eq 1 ]; } && cmp -s many.jsonl old.out; then
            pass
        else
            fail "batch after $after s: exit $code"
        fi
        echo old >old.out
        find . -name '*.tmp' | grep . && fail "batch after $after s left a file"
    done
else
    skipped=$((skipped + 1))
    echo 'skipped: there is no timeout, or env has no --default-signal'
fi

# ---- killed outright: the unfinished file stays, and the next run into that name removes it, and no other file

kill_batch() { # kill_batch NAME: leaves the unfinished file of a batch into NAME
    "$OVOID_TOOL" batch --shapes shapes.txt --pairs - --json -o "$1" <killed.fifo >/dev/null 2>&1 &
    exec 3>killed.fifo
    cat many.csv >&3
    kill -KILL $!
    wait $! 2>/dev/null
    exec 3>&-
}
mkfifo killed.fifo
mkdir deep
for target in new.out old.out deep/linked.out; do
    if [ $target = deep/linked.out ]; then ln -s ../linked.json deep/linked.out; fi
    kill_batch $target
    left=$(find . -name '*.tmp')
    if [ -n "$left" ]; then pass; else fail "killed, $target: nothing is left behind, which this is about"; fi
    gone=$(echo "$left" | sed 's/.*out\.//; s/.*json\.//; s/-0.tmp//')
    # Not ours to remove: of a process that lives, of another name, no file.
    sleep 100 &
    alive=$!
    mkdir "$target.$gone-7.tmp"
    ln -s scene.json "$target.$gone-8.tmp"
    for name in "$target.$alive-0.tmp" "$target.1-0.tmp" "$target.$gone-x.tmp" "$target.$gone-.tmp" "$target.0$gone-0.tmp" "$target.99999999999999999999-0.tmp" \
        "$target.$gone-0.tmpx" "$target.x$gone-0.tmp" "other.$target.$gone-0.tmp" "$target$gone-0.tmp"; do
        (mkdir -p "$(dirname "$name")" && echo mine >"$name")
    done
    kept=$(find . -name '*.tmp*' | grep -vFx -- "$left" | sort)
    "$OVOID_TOOL" batch --shapes shapes.txt --pairs pairs.csv --json -o $target 2>err
    code=$?
    if [ $code -le 1 ] && [ "$(find . -name '*.tmp*' | sort)" = "$kept" ]; then
        pass
    else
        fail "after a kill, $target: exit $code; there were $left $kept; there are $(find . -name '*.tmp*' | sort)"
    fi
    kill $alive
    find . -name '*.tmp*' -exec rm -rf {} +
    rm -rf new.out linked.json other.*
    echo old >old.out
done

# ---- bad input in the middle: the file that was there stays

(cat many.csv && echo 0,1,nonsense) >broken.csv
for target in new.out old.out; do
    "$OVOID_TOOL" batch --shapes shapes.txt --pairs broken.csv --json -o $target 2>err
    code=$?
    expect "bad line, $target" 3 'broken.csv:12002:'
    clean "bad line, $target"
done

# ---- motions: none, cut short, of nonsense

: >none.csv
for run in "none.csv" "." "many.csv" "missing.csv"; do
    "$OVOID_TOOL" run scene.json --motion $run --csv -o new.out 2>err
    code=$?
    expect "run, $run" 3 "$run:"
    clean "run, $run"
done
(head -n 400 long_fall.csv && printf '999,tee,nan,0,0,1,0,0,0\n') >broken.csv
for target in new.out old.out; do
    "$OVOID_TOOL" run moving.json --motion broken.csv --json -o $target 2>err
    code=$?
    expect "bad line of a motion, $target" 3 'broken.csv:401: column x is not finite'
    clean "bad line of a motion, $target"
done
"$OVOID_TOOL" run scene.json --motion - --csv <&- >/dev/null 2>err
code=$?
expect 'run, standard input closed' 3 'Bad file descriptor'
# A step so long, a turn so fast that arithmetic does not follow: nothing is claimed.
printf 'time,body,x,y,z,qw,qx,qy,qz\n-1e308,ball,9,9,9,1,0,0,0\n1e308,ball,9,9,8,1,0,0,0\n' >long.csv
"$OVOID_TOOL" run scene.json --motion long.csv --margin 0 --continuous >/dev/null 2>err
code=$?
expect 'run, a step of no finite length' 3 'its duration must be'
printf 'time,body,vx,vy,vz,wx,wy,wz\n0,ball,0,0,0,1e20,0,0\n1,ball,0,0,0,0,0,0\n' >fast.csv
"$OVOID_TOOL" run scene.json --motion fast.csv >/dev/null 2>err
code=$?
expect 'run, a turn too fast' 3 'object "ball"'

# ---- 100 000 objects: little memory, no pair lost. Each box touches the next one of its row of 100, and no other.

awk 'BEGIN { printf "{\"objects\":["
    for (i = 0; i < 100000; i++) printf "%s{\"name\":\"n%d\",\"box\":[1,1,1],\"pose\":{\"xyz\":[%d,%d,%d]}}", i ? "," : "", i, i % 100, 2 * int(i / 100 % 100), 2 * int(i / 10000)
    print "]}" }' >huge.json
"$OVOID_TOOL" check huge.json --margin 0 --csv -o huge.csv 2>err
code=$?
expect '100 000 objects' 1 '100000 objects'
lines=$(wc -l <huge.csv)
if [ "$lines" -eq 99001 ]; then pass; else fail "100 000 objects: $lines lines, not 99001"; fi
rm -f huge.json huge.csv
# ---- more threads than there is work: none of them is started, which memory shows (sanitizers need terabytes of addresses)

# shellcheck disable=SC3045 # where ulimit has no -v, there is no limit
if (ulimit -v 400000 && "$OVOID_TOOL" --version) >/dev/null 2>&1; then addresses=400000; else addresses=; fi

for run in "batch --shapes shapes.txt --pairs pairs.csv --json -o threads.jsonl" "verify threads.jsonl --shapes shapes.txt --pairs pairs.csv" \
    "check scene.json" "check scene.json --margin 1" "robot check arm/arm.urdf --states arm/states.csv"; do
    # shellcheck disable=SC3045,SC2086 # Debian's sh has ulimit -v; a command line
    (
        if [ "$addresses" ]; then ulimit -v $addresses; fi
        exec timeout 20 "$OVOID_TOOL" $run --threads 1000000000
    ) >/dev/null 2>err
    code=$?
    case $code in 0 | 1 | 4) pass ;; *) fail "many threads, $run: exit $code: $(head -c 200 err)" ;; esac
done
rm -f threads.jsonl
# ---- streams that are closed or full

"$OVOID_TOOL" verify - scene.json <&- >/dev/null 2>err
code=$?
expect 'standard input closed' 3 'Bad file descriptor'
"$OVOID_TOOL" distance missing.off cube.off 2>/dev/full
code=$? && : >err
expect 'standard error full' 3 ''
"$OVOID_TOOL" distance missing.off cube.off 2>&-
code=$? && : >err
expect 'standard error closed' 3 ''
"$OVOID_TOOL" check scene.json -o new.out 0<&- 1>&- 2>&-
code=$?
if [ $code -eq 1 ] && [ "$(grep -c overlapping new.out)" -ge 1 ]; then pass; else fail "all streams closed: exit $code"; fi
rm -f new.out

# ---- little memory, little stack (sanitizers need terabytes of addresses, and much stack)

# nest N OPEN CLOSE: OPEN N times, then CLOSE N times.
nest() { awk -v n="$1" -v open="$2" -v close_="$3" 'BEGIN { for (i = 0; i < n; i++) printf "%s", open; for (i = 0; i < n; i++) printf "%s", close_ }'; }

for n in 65 2000 100000; do
    (printf '{\n"objects": ' && nest $n '[' ']' && printf '}') >deep.json
    (printf '{"objects":\n[{"name": "a", "box": [1, 1, 1], "pose": ' && nest $n '{"xyz":' '}' && printf '}]}') >deeper.json
    (printf '{"a": ' && nest $n '[' ']' && echo '}') >deep.jsonl
    (printf '<robot name="r">\n' && nest $n '<a>' '</a>' && printf '</robot>') >deep.urdf
    (printf '<robot name="r">\n' && nest $n '<group name="g">' '</group>' && printf '</robot>') >deep.srdf
    (printf 'world:\n  ' && nest $n '[' ']' && echo) >deep.yaml
    (printf 'world:\n  ' && nest $n '{a: ' '}' && echo) >deeper.yaml
    nest $n '- ' '' >deepest.yaml
    for run in "check deep.json" "check deeper.json" "verify deep.jsonl scene.json" "robot info deep.urdf" \
        "robot info arm/arm.urdf --srdf deep.srdf" "robot check arm/arm.urdf --scene deep.json --state shoulder=0" \
        "robot check arm/arm.urdf --scene deep.yaml --state shoulder=0" "robot check arm/arm.urdf --scene deeper.yaml --state shoulder=0" \
        "robot check arm/arm.urdf --scene deepest.yaml --state shoulder=0"; do
        # shellcheck disable=SC2086,SC3045 # a command line; Debian's sh has ulimit -s
        (
            if [ -z "${OVOID_SANITIZE:-}" ]; then ulimit -s 128; fi
            exec timeout 20 "$OVOID_TOOL" $run
        ) >/dev/null 2>err
        code=$?
        expect "nested $n deep, $run" 3 'deep[a-z]*\.[a-z]*:[12]: .*nested more than 64 deep'
    done
done

if [ "$addresses" ]; then
    for run in "fit many.obj" "check many.json -o new.out" "distance many.obj cube.off"; do
        (
            # shellcheck disable=SC3045
            ulimit -v 60000
            # shellcheck disable=SC2086 # a command line
            exec "$OVOID_TOOL" $run
        ) >/dev/null 2>err
        code=$?
        case $code in
        0 | 1) pass ;; # it was enough
        3) expect "little memory, $run" 3 'memory' ;;
        *) fail "little memory, $run: exit $code: $(head -c 200 err)" ;;
        esac
        rm -f new.out
        clean "little memory, $run"
    done
    # A line that is too long for the memory is no end of the file: no states, no lines of shards are lost.
    { printf 'shoulder\n0\n' && head -c 70000000 /dev/zero | tr '\0' ' ' && printf '\n1\n'; } >blanks.csv
    # shellcheck disable=SC3045
    (ulimit -v 60000 && exec "$OVOID_TOOL" robot path arm/arm.urdf --states blanks.csv) >/dev/null 2>err
    code=$?
    expect 'a long line of states' 3 'blanks.csv:3: the line is too long for the memory'
    rm -f blanks.csv
    { printf 'world:\n  collision_objects:\n  - id: ' && head -c 40000000 /dev/zero | tr '\0' a &&
        printf '\n    primitives: [{type: box, dimensions: [9, 9, 9]}]\n    primitive_poses: [{position: [0, 0, 0]}]\n'; } >long.yaml
    printf 'shoulder\n99\n0\n' >two.csv
    "$OVOID_TOOL" robot check arm/arm.urdf --scene long.yaml --states two.csv --json --shard 1/1 -o long.jsonl 2>err
    # shellcheck disable=SC3045
    (ulimit -v 50000 && exec "$OVOID_TOOL" merge long.jsonl) >/dev/null 2>err
    code=$?
    expect 'a long line of a shard' 3 'long.jsonl: a line cannot be read: Cannot allocate memory'
    rm -f long.yaml long.jsonl long.jsonl.mark
    # The least stack of a thread with the C library of musl: 128 KB.
    printf 'v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\nf 4 3 2 1\nf 6 5 4 1\nf 7 8 9 10\nf 7 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n' >l.obj
    for run in "distance cube.off tetra.obj" "distance many.obj cube.off" "distance l.obj cube.off --hull" "check scene.json" \
        "run moving.json --motion fall.csv --continuous" "fit many.obj" "decompose l.obj" "view scene.json -o l.svg" \
        "robot check arm/arm.urdf --scene arm/cell.yaml --states arm/states.csv" "robot info arm/arm.urdf --srdf arm/arm.srdf"; do
        # shellcheck disable=SC2086,SC3045 # a command line; Debian's sh has ulimit -s
        (ulimit -s 128 && exec "$OVOID_TOOL" $run) >/dev/null 2>err
        code=$?
        if [ $code -le 1 ] || [ $code -eq 4 ]; then pass; else fail "little stack, $run: exit $code: $(head -c 200 err)"; fi
    done
else
    skipped=$((skipped + 1))
    echo 'skipped: memory cannot be limited here'
fi

echo "$passed passed, $failed failed, $skipped skipped"
[ $failed -eq 0 ]
