#!/usr/bin/env bash
# An export for Godot, shown by Godot, against surimi preview: godot.sh SURIMI SCENES
# Needs `npm ci --ignore-scripts` in this folder, Chromium, and oiiotool.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
surimi=$1
scene=$2/home-theater/home-theater.glb
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Two maps, so that each part of a mesh has to find its own.
"$surimi" bake "$scene" --size 256 --atlases 2 --quality draft --quiet -o "$work" --export godot >/dev/null
"$surimi" preview "$work/home-theater.baked.glb" -o "$work/preview.exr" --size 640 360 --samples 1 --camera 2 0.8 2 \
    --look-at -0.5 -0.5 -3 --fov 60 --light Monitor_R=1.5,1.4,1.3 --progress none --quiet >/dev/null
echo '{"name": "home-theater", "eye": [2, 0.8, 2], "target": [-0.5, -0.5, -3], "fov": 60, "radiance": [1.5, 1.4, 1.3]}' >"$work/view.json"
node "$here/show.mjs" "$work/export/godot" "$work/view.json" "$work/godot.png"

# As Godot's Compatibility renderer encodes it: the power of sRGB without its line near black.
oiiotool "$work/preview.exr" --ch R,G,B --clamp:min=0:max=1 --powc 0.416666667 --mulc 1.055 --subc 0.055 \
    --clamp:min=0:max=1 -d uint8 -o "$work/preview.png"
# Two steps of 8 bits (the map that a running Godot reads has 8) but for one pixel in 500, at edges.
oiiotool "$work/preview.png" "$work/godot.png" --ch R,G,B --fail 0.0081 --failpercent 0.2 --diff
