# What the tests of tools' manners share: sourced by them, with $tool set, with their arguments.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# SCRIPT BUILD_FOLDER [NAME... | -NAME...]: every function test_NAME of the script, or only those
# named, or all but those named.
set -u
build=$(cd "$1" && pwd) || exit 2
names=" ${*:2} "
PATH=$build/bin:$build/tests:$PATH
script=$(cd "$(dirname "$0")" && pwd)/$(basename "$0")
folder=$(mktemp -d) && cd "$folder" || exit 2
trap 'rm -rf "$folder"' EXIT
: >stdout >stderr
failures=0

# fail TEXT: notes a failure of the test that runs.
fail() {
    echo "FAILED $name: $1"
    [ -s stderr ] && sed 's/^/    /' stderr
    echo "    rerun: bash $script $build $name"
    failures=$((failures + 1))
}

# expect STATUS COMMAND...: runs it and checks its exit status; standard output and error are kept
# in the files stdout and stderr. A status from 64 on wants one line of error.
expect() {
    local wanted=$1
    shift
    "$@" >stdout 2>stderr
    local found=$?
    [ $found -eq "$wanted" ] || fail "'$*' gave $found, expected $wanted"
    if [ "$wanted" -ge 64 ] && [ "$wanted" -lt 128 ]; then
        [ "$(wc -l <stderr)" -eq 1 ] || fail "'$*': expected one line, the error"
        grep -q "^$tool: error: " stderr || fail "'$*': its error does not say who speaks"
    fi
}

# nothing_left: no output, and no temporary of one.
nothing_left() {
    local left
    left=$(find . -name 'out*' -o -name '.out*')
    [ -z "$left" ] || fail "left behind: $left"
    rm -f $left
}

# refuses STATUS ARGUMENTS...: the tool fails so, prints nothing, and leaves nothing.
refuses() {
    local wanted=$1 before
    shift
    before=$(ls -A)
    expect "$wanted" "$tool" "$@"
    [ -s stdout ] && fail "'$*': it wrote to standard output"
    nothing_left
    [ "$before" = "$(ls -A)" ] || fail "'$*': other files than before: $(ls -A | tr '\n' ' ')"
}

says() { grep -q -e "$1" stderr || fail "expected '$1' on standard error"; }
prints() { grep -q -e "$1" stdout || fail "expected '$1' on standard output"; }

# holds FILE.json FILTER: jq's filter says true.
holds() { jq -e "$2" "$1" >/dev/null || fail "$1: not so: $2"; }

# dies_by SIGNAL COMMAND...: ended by the signal while at work, it leaves nothing.
dies_by() {
    local signal=$1 process status
    shift
    # Through env, since bash makes background jobs ignore SIGINT for good.
    env --default-signal=INT "$@" 2>/dev/null &
    process=$!
    for _ in $(seq 500); do
        [ -n "$(find . -name '.out*')" ] && break
        sleep 0.01
    done
    sleep 0.2
    kill "-$signal" $process 2>/dev/null
    wait $process
    status=$?
    [ $status -eq $((128 + $(kill -l "$signal"))) ] || fail "status $status after SIG$signal"
    nothing_left
}

# pipe_breaks COMMAND...: when its reader goes after some bytes, it ends as SIGPIPE does, quietly.
pipe_breaks() {
    "$@" 2>stderr | head -c 10 >/dev/null
    local status=${PIPESTATUS[0]}
    [ "$status" -eq 141 ] || fail "'$*' gave $status into a closed pipe, expected 141"
    [ -s stderr ] && fail "'$*' talks about a closed pipe"
}

# help_is_cut: so does a help or a plan that nobody reads to its end.
help_is_cut() {
    local status=0
    "$tool" --help 2>stderr | true
    status=${PIPESTATUS[0]}
    # The help may fit the pipe before its reader goes.
    [ "$status" -eq 141 ] || [ "$status" -eq 0 ] || fail "--help gave $status into a closed pipe"
    [ -s stderr ] && fail "--help talks about a closed pipe"
    { sleep 0.3; exec "$tool" --help; } 2>stderr | true
    status=${PIPESTATUS[0]}
    [ "$status" -eq 141 ] || fail "--help gave $status into a closed pipe, expected 141"
    [ -s stderr ] && fail "--help talks about a closed pipe"
}

# run_tests: all of the script's, and the exit status.
run_tests() {
    for name in $(declare -F | sed -n 's/^declare -f test_//p'); do
        case $names in
        *" $name "*) ;;
        *" -$name "*) continue ;;
        *" "[!\ -]*) continue ;;
        esac
        "test_$name"
    done
    [ $failures -eq 0 ] && echo "all passed" || echo "$failures failed"
    exit $((failures > 0))
}
