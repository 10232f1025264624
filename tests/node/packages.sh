#!/usr/bin/env bash
# packages.sh FOLDER: the npm packages of package-lock.json, exactly those, in FOLDER/node_modules;
# fetched once. Exit status 77, with a reason, where they cannot be had: a test that then says
# "skipped" is honest, one that passes is not.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=$1
mkdir -p "$folder"
exec 9>"$folder/lock"
flock 9 # tests run side by side

for program in node npm; do
    command -v "$program" >/dev/null || {
        echo "SKIPPED: there is no '$program'; install nodejs and npm (packages.txt)"
        exit 77
    }
done
cmp -s "$here/package-lock.json" "$folder/fetched" && exit 0

rm -f "$folder/fetched"
cp "$here/package.json" "$here/package-lock.json" "$folder/"
if ! (cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund --fetch-retries=1 \
    --fetch-timeout=30000 --cache "$folder/cache") >"$folder/npm.log" 2>&1; then
    cat "$folder/npm.log"
    if grep -qE 'ENOTFOUND|EAI_AGAIN|ECONN(REFUSED|RESET)|E(SOCKET)?TIMEDOUT|ENETUNREACH|EHOSTUNREACH' "$folder/npm.log"; then
        echo "SKIPPED: the npm registry $(npm config get registry 2>/dev/null) cannot be reached"
        exit 77
    fi
    exit 1
fi
cp "$here/package-lock.json" "$folder/fetched"
