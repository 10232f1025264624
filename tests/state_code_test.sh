#!/usr/bin/env bash
# Looks into the machine code of the rooms that make a tick, and into the libm that they are linked
# with: nothing may depend on the CPU that it runs on, and nothing may ask for the time, the
# environment, the locale or the C library's random numbers.
# usage: state_code_test.sh BUILD_FOLDER [ARCHIVE...]
set -euo pipefail
build=$1
shift
archives=("$@")
((${#archives[@]})) || archives=("$build"/{world,walkers,scripting,traffic,kernel}/lib*.a
                                 "$build/generated/portable_math.o")

# Fused multiply-add; approximations that differ by vendor; questions to the CPU; x87 arithmetic
# other than musl's own; changes of the floating-point mode.
instructions='\s(vf(n)?m(add|sub)|(v)?rcp[ps]s|(v)?rsqrt[ps]s|cpuid|(v)?ldmxcsr)'
functions=' U (time|clock|clock_gettime|gettimeofday|localtime(_r)?|gmtime(_r)?|getenv|secure_getenv|setlocale|s?rand(_r)?|drand48|random|getpid|gettid|pthread_self|_ZNSt13random_device.*|_ZNSt6chrono3_V2.*now.*)$'

found=0
for archive in "${archives[@]}"; do
    [[ -f $archive ]] || { echo "$archive is not there"; exit 2; }
    if objdump -d --no-show-raw-insn "$archive" | grep -E "$instructions" | head -5 | grep .; then
        echo "   <- $archive: such instructions differ by CPU or change the arithmetic"
        found=1
    fi
    if nm -A "$archive" 2>/dev/null | grep -E "$functions"; then
        echo "   <- $archive: a tick depends on nothing outside"
        found=1
    fi
done

# The same flags for every file of these rooms.
commands=$build/compile_commands.json
for flag in -ffp-contract=off -march=x86-64; do
    bad=$(grep -E '"command"' "$commands" | grep -E '/(world|walkers|scripting|traffic|kernel)/[a-z_]+\.cpp"?' |
        grep -vc -- "$flag" || true)
    ((bad == 0)) || { echo "$bad files are compiled without $flag"; found=1; }
done
if grep -E '"command"' "$commands" | grep -E -- '-ffast-math|-Ofast|-march=native|-funsafe-math' | head -3 | grep .; then
    echo "   <- such flags give other bits"
    found=1
fi
exit $found
