#!/bin/bash
# Runs every fuzzing target: fuzz.sh BUILD SECONDS OUT. What is found lands in OUT/NAME; the corpus in
# tests/fuzz/corpus/NAME is only read.
# SPDX-License-Identifier: GPL-3.0-or-later
set -u
build=$1 seconds=$2 out=$3 status=0
for target in "$build"/fuzz/*_fuzz; do
    name=$(basename "$target" _fuzz)
    mkdir -p "$out/$name" tests/fuzz/corpus/"$name"
    echo "fuzz: $name for $seconds s"
    # Memory that vendors' readers leave behind when they throw is no fault that we look for, nor is
    # that of a large picture.
    ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 \
        "$target" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=12000 -print_final_stats=1 \
        -artifact_prefix="$out/$name/" "$out/$name" "tests/fuzz/corpus/$name" \
        >"$out/$name.log" 2>&1 || { status=1; tail -40 "$out/$name.log"; }
    grep -h "number_of_executed_units\|peak_rss_mb" "$out/$name.log"
done
exit $status
