#!/usr/bin/env bash
# Shading against brute force on real rooms, by roughness, and the time of a frame:
# preview.sh SURIMI SCENES [REFERENCE_SAMPLES] prints Markdown; pictures go to $OUT, a temporary folder by default.
set -euo pipefail
surimi=$1 scenes=$2 samples=${3:-256}
work=${OUT:-$(mktemp -d)}
mkdir -p "$work"
[[ -n ${OUT:-} ]] || trap 'rm -rf "$work"' EXIT

for scene in home-theater living-room classroom; do
    baked=$work/$scene.baked.glb
    [[ -f $baked ]] || "$surimi" bake "$scenes/$scene/$scene.glb" -o "$work" --quiet >/dev/null
done

echo "| scene, light | roughness | pixels | RMSE | relative MSE | mean abs. | largest |"
echo "|---|---|--:|--:|--:|--:|--:|"
for scene in home-theater living-room classroom; do
    for visibility in none baked; do
        "$surimi" preview "$work/$scene.baked.glb" -o "$work/$scene.$visibility.png" --size 512 288 --samples 1 \
            --visibility $visibility --compare --reference-samples "$samples" --json --quiet >"$work/numbers.json"
        node - "$work/numbers.json" "$scene, $([[ $visibility == none ]] && echo unshadowed || echo shadowed)" <<'JS'
const [file, name] = process.argv.slice(2);
const all = JSON.parse(require("fs").readFileSync(file));
const row = (label, band, d, pixels) => console.log(`| ${label} | ${band} | ${pixels} | ${d.rmse.toFixed(4)} | ` +
    `${d.relativeMse.toFixed(4)} | ${d.meanAbsolute.toFixed(4)} | ${d.largest.toFixed(2)} |`);
for (const band of all.bands) if (band.pixels > 0) row(name, band.roughness.join(" to "), band, band.pixels);
row(name, `all; FLIP ${all.flip.toFixed(3)}, reference noise ${all.referenceNoise.toFixed(4)}`, all, 512 * 288);
JS
    done
done

echo
echo "| scene, 1920 x 1080 | monitors | samples of a pixel | seconds |"
echo "|---|--:|--:|--:|"
for scene in home-theater living-room classroom; do
    for side in 1 2; do
        seconds=$("$surimi" preview "$work/$scene.baked.glb" -o "$work/hd.png" --size 1920 1080 --samples $side \
            --progress json 2>&1 >/dev/null | sed -n 's/.*"picture","fraction":1.000,"seconds":\([0-9.]*\).*/\1/p')
        monitors=$("$surimi" inspect "$work/$scene.baked.glb" --json | node -e '
            console.log(JSON.parse(require("fs").readFileSync(0)).monitors.length)')
        echo "| $scene | $monitors | $((side * side)) | $seconds |"
    done
done
