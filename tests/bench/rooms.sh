#!/usr/bin/env bash
# Bakes real rooms at 1024 x 1024 with the default settings, or BAKE_OPTIONS, and prints what it cost and how far the maps are from an
# independent oracle, as rows of a Markdown table: rooms.sh SURIMI SCENES ORACLE [POINTS]
# ORACLE is called as `ORACLE check BAKED.glb MAP.exr MONITORS POINTS SEED SIDE`.
set -euo pipefail
surimi=$1 scenes=$2 oracle=$3 points=${4:-20000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

echo "| scene | triangles | seconds | M rays | M rays/s | peak MiB | texels measured / unlit / filled | mean abs. error | RMSE | non-finite |"
echo "|---|--:|--:|--:|--:|--:|---|--:|--:|--:|"
for scene in home-theater garage living-room classroom veach-ajar; do
    file=$scenes/$scene/$scene.glb
    # shellcheck disable=SC2086 # several options
    "$surimi" bake "$file" -o "$work" --quiet ${BAKE_OPTIONS:-} >/dev/null
    "$surimi" inspect "$file" --json >"$work/inspect.json"
    monitors=$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).monitors.map(m => m.name).join()' "$work/inspect.json")
    "$oracle" check "$work/$scene.baked.glb" "$work/$scene.visibility.exr" "$monitors" "$points" 1 16 >"$work/oracle.txt"
    node - "$scene" "$work" <<'JS'
const fs = require("fs"), [scene, work] = process.argv.slice(2);
const inspect = JSON.parse(fs.readFileSync(`${work}/inspect.json`));
const manifest = JSON.parse(fs.readFileSync(`${work}/${scene}.visibility.json`));
const oracle = fs.readFileSync(`${work}/oracle.txt`, "utf8").trim().split("\n");
const stages = manifest.run.stages;
const seconds = stages.reduce((sum, s) => sum + s.seconds, 0);
const peak = Math.max(...stages.map(s => s.peakBytes)) / 2 ** 20;
manifest.monitors.forEach((monitor, i) => {
    const stage = `light from ${monitor.name}`;
    const rays = manifest.rays[stage] / 1e6, time = stages.find(s => s.stage === stage).seconds;
    const texels = manifest.texels[monitor.channel];
    const figure = key => new RegExp(`(?:^|[ :])${key}=([^ ]+)`).exec(oracle.find(l => l.startsWith(monitor.name + ":")))[1];
    const first = i === 0;
    console.log(`| ${scene} ${monitor.channel} | ${first ? inspect.triangles : ""} | ${first ? seconds.toFixed(1) : ""} | ${rays.toFixed(1)} | ` +
        `${(rays / time).toFixed(1)} | ${first ? peak.toFixed(0) : ""} | ${texels.covered} / ${texels.unlit} / ${texels.filled} | ` +
        `${figure("mae")} | ${figure("rmse")} | ${figure("nonfinite")} |`);
});
JS
done
