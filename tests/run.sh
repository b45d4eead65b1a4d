#!/usr/bin/env bash
# Installs what is missing, builds and runs every test. Real scenes beside the checkout (SURIMI_SCENES, else
# ../shared/scenes) are used where they exist.
set -euo pipefail
cd "$(dirname "$0")/.."
shopt -s nullglob

bash .ci/install.sh --tests
for folder in tests/cli tests/web tests/report tests/godot baker/report/page; do
    (cd "$folder" && npm ci --silent --no-audit --no-fund)
done
if [[ -z ${SURIMI_SCENES:-} && -d ../shared/scenes ]]; then
    SURIMI_SCENES=$(cd ../shared/scenes && pwd)
fi
export SURIMI_SCENES=${SURIMI_SCENES:-} # empty: the tests that need them are skipped

echo "== release: build"
cmake --preset release -DSURIMI_TESTS=ON >/dev/null
cmake --build --preset release
echo "== release: test"
ctest --test-dir build/release --no-tests=error --output-on-failure -j "$(nproc)"

echo "== sanitizers: build"
cmake --preset asan >/dev/null
cmake --build --preset asan --target unit_tests stability_tests
echo "== sanitizers: test"
# Embree and TBB keep memory until the process ends, by design.
ASAN_OPTIONS=detect_leaks=0 ctest --test-dir build/asan --no-tests=error --output-on-failure -j "$(nproc)" -L 'unit|stability'
