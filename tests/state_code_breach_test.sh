#!/usr/bin/env bash
# The look into the machine code must fail for a fused multiply-add, and for a call for the time.
set -euo pipefail
source=$1 build=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
check() { "$source/tests/state_code_test.sh" "$build" "$folder/$1.o" >/dev/null; }

echo 'double f(double a) { return a + 1; }' | cc -O2 -x c -c - -o "$folder/good.o"
check good
echo 'double f(double a, double b) { return __builtin_fma(a, b, a); }' |
    cc -O2 -mfma -x c -c - -o "$folder/fused.o"
if check fused; then
    echo "not found: a fused multiply-add"
    exit 1
fi
printf '#include <time.h>\nlong f(void) { return time(0); }\n' | cc -O2 -x c -c - -o "$folder/clock.o"
if check clock; then
    echo "not found: a question for the time"
    exit 1
fi
