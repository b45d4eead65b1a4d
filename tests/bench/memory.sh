#!/usr/bin/env bash
# Peak memory that `surimi plan` foretells beside that of the whole bake, files included, as the kernel saw it, as rows of
# a Markdown table: memory.sh SURIMI SCENES [SCENE:SIZE:ATLASES[:OPTIONS]]...
# Light is taken by one ray a texel where OPTIONS do not say otherwise: it is the sizes that count. Needs GNU time.
set -euo pipefail
surimi=$1 scenes=$2
shift 2
[ $# -gt 0 ] || set -- cornell-box:2048:1 cornell-box:4096:1 garage:1024:1 garage:2048:2 living-room:2048:1 \
    classroom:1024:1 classroom:2048:2 "classroom:2048:1:--audit 1" "home-theater:2048:1:--supersample 2"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

echo "| scene | size | maps | options | monitors | plan MiB | bake MiB | plan / bake | seconds |"
echo "|---|--:|--:|---|--:|--:|--:|--:|--:|"
for run in "$@"; do
    IFS=: read -r scene size atlases options <<<"$run"
    file=$(echo "$scenes/$scene"/*.glb)
    # shellcheck disable=SC2206 # several options
    settings=(--size "$size" --atlases "$atlases" --method mc --samples 1 $options)
    "$surimi" plan "$file" "${settings[@]}" --json --quiet >"$work/plan.json"
    /usr/bin/time -f "%M %e" -o "$work/time" "$surimi" bake "$file" "${settings[@]}" -o "$work/out" --quiet --no-report >/dev/null
    rm -rf "$work/out"
    node - "$work" "$scene" "$size" "$options" <<'JS'
const fs = require("fs"), [work, scene, size, options] = process.argv.slice(2);
const plan = JSON.parse(fs.readFileSync(`${work}/plan.json`));
const [peak, seconds] = fs.readFileSync(`${work}/time`, "utf8").trim().split(" ").map(Number);
const foretold = plan.run.memory.peak / 2 ** 20, truth = peak / 1024;
console.log(`| ${scene} | ${size} | ${plan.map.pages} | ${options} | ${plan.monitors.length} | ${foretold.toFixed(0)} | ` +
    `${truth.toFixed(0)} | ${(foretold / truth).toFixed(2)} | ${seconds.toFixed(0)} |`);
JS
done
