#!/usr/bin/env bash
# Fails when a file is not laid out as .clang-format says; with --fix, lays it out.
set -euo pipefail
cd "$(dirname "$0")/../.."
mapfile -t files < <(find runtime baker samples tests -name node_modules -prune -o '(' -name '*.h' -o -name '*.cpp' ')' -print)
((${#files[@]} > 20)) || { echo "only ${#files[@]} files found" >&2; exit 1; }
if [[ ${1:-} == --fix ]]; then
    clang-format -i "${files[@]}"
else
    clang-format --dry-run -Werror "${files[@]}"
fi
