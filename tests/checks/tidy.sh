#!/usr/bin/env bash
# clang-tidy on the sources that changed, each alone; a changed header is looked at through its own
# source file, or through one that includes it. All warnings are errors: .clang-tidy names only checks
# that the code keeps.
# usage: tidy.sh [BASE]   changed since this commit (default: where the branch left main; on main, what
#                         is not committed, or the last commit) | --all | FILE ...
set -euo pipefail
cd "$(dirname "$0")/../.."
build=build/tidy

# The commit to compare with.
default_base() {
    local main
    for main in origin/main main; do
        git rev-parse -q --verify "$main" >/dev/null || continue
        local fork
        fork=$(git merge-base HEAD "$main" 2>/dev/null) || continue
        [[ $fork == "$(git rev-parse HEAD)" ]] || { echo "$fork"; return; }
    done
    if [[ -n $(git status --porcelain) ]] || ! git rev-parse -q --verify HEAD~ >/dev/null; then
        git rev-parse HEAD
    else
        git rev-parse HEAD~
    fi
}

changed_since() {
    git diff --name-only --diff-filter=d "$1" -- '*.cpp' '*.h'
    git ls-files --others --exclude-standard -- '*.cpp' '*.h'
}

# The source file through which clang-tidy sees this one.
source_of() {
    local file=$1 stem=${1%.*}
    [[ $file == *.cpp ]] && echo "$file" && return
    [[ -f $stem.cpp ]] && echo "$stem.cpp" && return
    git grep -lE "#include \"($file|$(basename "$file"))\"" -- '*.cpp' | head -n 1 || true
}

case ${1:-} in
    --all) what="all files" chosen=$(git ls-files '*.cpp') ;;
    *.cpp | *.h) what="the files named" chosen=$(printf '%s\n' "$@") ;;
    *)
        base=${1:-$(default_base)}
        git rev-parse -q --verify "$base^{commit}" >/dev/null || {
            echo "no commit '$base'"
            exit 2
        }
        what="files changed since $(git log -1 --format='%h (%s)' "$base")" chosen=$(changed_since "$base")
        ;;
esac

# Compile commands, and what is included but made by the build.
if [[ ! -f $build/build.ninja ]]; then
    mkdir -p build
    cmake --preset tidy >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
fi
ninja -C "$build" -t targets rule CUSTOM_COMMAND | grep -E '^generated/.*\.h$' |
    xargs ninja -C "$build" build.ninja >"$build.log" || { cat "$build.log"; exit 1; }

sources=$(for file in $chosen; do source_of "$file"; done | sort -u)
# What this build does not compile (the fuzz target) has no command to look it up by.
sources=$(for file in $sources; do grep -qF "\"$PWD/$file\"" "$build/compile_commands.json" && echo "$file"; done || true)
[[ -n $sources ]] || { echo "no sources among $what"; exit 0; }

# The commands are GCC's, of whose warnings clang does not know all.
xargs -n 1 -P "$(nproc)" clang-tidy-14 -p "$build" --quiet --warnings-as-errors='*' \
    --extra-arg=-Wno-unknown-warning-option <<<"$sources" \
    2> >(grep -vE '^[0-9]+ warnings? generated|^Suppressed|^Use -header-filter' >&2)
echo "$(wc -w <<<"$sources") sources: $what"
