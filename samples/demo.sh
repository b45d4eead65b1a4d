#!/usr/bin/env bash
# Bakes a real scene and renders it lit by its monitors: samples/demo.sh [home-theater|classroom]
# As root or with sudo: it installs the Debian packages that are missing.
set -euo pipefail
cd "$(dirname "$0")/.."
scene=${1:-home-theater}
file=samples/scenes/$scene/$scene.glb
[[ -f $file ]] || { echo "there is no $file; choose one of: $(cd samples/scenes && ls -d */ | tr -d /| xargs)" >&2; exit 2; }

echo "1/4 packages"
bash .ci/install.sh
echo "2/4 build"
cmake --preset release -DSURIMI_TESTS=OFF >/dev/null
cmake --build --preset release --target surimi
surimi=build/release/bin/surimi
out=out/$scene
echo "3/4 bake"
"$surimi" inspect "$file"
"$surimi" bake "$file" -o "$out"
echo "4/4 render"
for show in lit unshadowed shadowed visibility texels; do
    "$surimi" preview "$out/$scene.baked.glb" -o "$out/$scene.$show.png" --show $show --progress none
done
cat <<TEXT

Open $out/$scene.report.html in a browser: the room, live, the map, how well it is and what it took. And these pictures:
  $out/$scene.lit.png             the room, lit by its monitors through the baked map
  $out/$scene.visibility.png      the map itself: R, G, B are the monitors
  $out/$scene.unshadowed.png      the light without shadows
  $out/$scene.shadowed.png        the light that arrives
  $out/$scene.texels.png          the lightmap's texels on the surfaces
and $out/$scene.baked.glb in any glTF viewer: it is the scene, and carries the map.
TEXT
