#!/usr/bin/env bash
# Bakes the room of the tests and shows it in three.js and Babylon.js.
#   run.sh SURIMI LTC_TEXTURES WORK
set -euo pipefail
export SURIMI=$1 SURIMI_WEB_WORK=$3
rm -rf "$SURIMI_WEB_WORK"
mkdir -p "$SURIMI_WEB_WORK"
"$2" "$SURIMI_WEB_WORK/ltc.bin"
cd "$(dirname "$0")"
node bake.mjs
node --test
