#!/usr/bin/env bash
# Portable pictures are equal on every x86-64 CPU: the code has nothing in it that differs, and makes
# the same on this CPU, for glibc on older ones, and on those that qemu can play.
# usage: portable_pictures_test.sh PORTABLE_PICTURES REPRISE_RENDER LIBRENDER.a CPU...
set -euo pipefail
pictures=$1
program=$2
archive=$3
shift 3
failed=0

# Fused multiply-add, approximations that differ by vendor, questions to the CPU.
instructions='\s(vf(n)?m(add|sub)|(v)?rcp[ps]s|(v)?rsqrt[ps]s|cpuid)'
if objdump -d --no-show-raw-insn "$archive" | grep -E "$instructions" | head -5 | grep .; then
    echo "   <- $archive: such instructions differ by CPU"
    failed=1
fi
# glibc chooses these by CPU; what it rounds, and its square root, are exact.
inexact=' (a?(sin|cos|tan)h?|atan2|sincos|exp(2|10|m1)?|log(2|10|1p)?|pow|cbrt|hypot|erfc?|[tl]gamma)f?@'
for each in "$pictures" "$program"; do
    if nm -D --undefined-only "$each" | grep -E "$inexact"; then
        echo "   <- $each: taken from the C library, not from cmake/PortableMath.cmake"
        failed=1
    fi
done

expected=$("$pictures")
(($(wc -l <<<"$expected") == 44)) || { echo "forty-four pictures and measurements expected:"; echo "$expected"; exit 1; }
compare() {
    local name=$1
    shift
    diff <(echo "$expected") <("$@") || { echo "   <- $name: other pictures than here"; failed=1; }
}
for mask in -FMA,-FMA4 -AVX,-AVX2,-FMA,-FMA4,-SSE4_1,-SSE4_2; do
    compare "glibc $mask" env GLIBC_TUNABLES=glibc.cpu.hwcaps=$mask "$pictures"
done
for cpu in "$@"; do
    expected=$(tail -n 22 <<<"$expected")  # an emulated CPU takes twenty times as long
    compare "qemu's $cpu" qemu-x86_64 -cpu "$cpu" "$pictures" furnished
done
exit $failed
