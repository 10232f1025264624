#!/usr/bin/env bash
# The start and goal pairs of a town are those that make_tasks chooses: tasks_test.sh MAKE_TASKS TOWN
set -euo pipefail
made=$(mktemp)
trap 'rm -f "$made"' EXIT
"$1" "$2/$(basename "$2").net.xml" "$made"
cmp "$made" "$2/tasks.json"
