#!/usr/bin/env bash
# The command line as a user meets it: commands.sh SURIMI SCENES. Every exit code, no half files, the input untouched.
set -uo pipefail
surimi=$(realpath "$1")
theater=$(realpath "$2")/home-theater/home-theater.glb
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
checks=0
failures=0

fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}
# expect CODE TEXT COMMAND...: the exit code, and TEXT somewhere in what it prints.
expect() {
    local code=$1 text=$2
    shift 2
    checks=$((checks + 1))
    "$@" >"$work/stdout" 2>"$work/stderr"
    local got=$?
    [[ $got == "$code" ]] || fail "exit code $got in place of $code: $*: $(tail -n 2 "$work/stderr")"
    grep -qF -- "$text" "$work/stdout" "$work/stderr" || fail "no \"$text\" in the output of: $*: $(tail -n 3 "$work/stderr")"
}
check() {
    checks=$((checks + 1))
    "$@" || fail "$*"
}

# 0, and the help
expect 0 "Exit codes" "$surimi" --help
expect 0 "draft = error 0.02" "$surimi" bake --help
expect 0 "surimi 0." "$surimi" --version

# 2: usage and configuration
expect 2 "did you mean bake" "$surimi" bkae x.glb
expect 2 "did you mean --samples" "$surimi" bake "$theater" --sample 3
expect 2 "" "$surimi"
expect 2 "samples must be" "$surimi" bake "$theater" --method mc --samples -1
expect 2 "error must be" "$surimi" bake "$theater" --error 0
expect 2 "error must be" "$surimi" bake "$theater" --error nan
expect 2 "error must be" env SURIMI_ERROR=1.5 "$surimi" bake "$theater"
expect 2 "time must be" "$surimi" bake "$theater" --time 0
expect 2 "audit must be" "$surimi" bake "$theater" --audit -1
expect 2 'did you mean "scanline"' "$surimi" bake "$theater" --method scanlines
expect 2 'did you mean "draft"' "$surimi" bake "$theater" --quality drat
expect 2 "add --method mc" "$surimi" bake "$theater" --samples 64
expect 2 "add --method mc" "$surimi" bake "$theater" --samples 64 --exact
expect 2 "high stands for error 0.001" "$surimi" bake "$theater" --quality high --error 0.01
expect 2 "quality and exact" "$surimi" bake "$theater" --quality high --exact
expect 2 "only splitting is exact" "$surimi" bake "$theater" --exact --method mc
expect 2 "time and error" "$surimi" bake "$theater" --time 10 --error 0.01
expect 2 "SURIMI_EXACT" env SURIMI_EXACT=perhaps "$surimi" bake "$theater"
expect 2 "SURIMI_SAMPLES" env SURIMI_SAMPLES=many "$surimi" bake "$theater"
expect 2 "size must be" "$surimi" bake "$theater" --size 4
expect 2 "" "$surimi" bake "$theater" --size 64 --density 3
expect 2 "mips must be" "$surimi" unwrap "$theater" --mips 9
expect 2 "atlases must be" "$surimi" unwrap "$theater" --atlases 17
expect 2 "stretch must be" "$surimi" unwrap "$theater" --stretch 1
expect 2 "uv-quality must be" "$surimi" unwrap "$theater" --uv-quality best
expect 2 "existing or auto" "$surimi" unwrap "$theater" --uv none
expect 2 "a .glb is written" "$surimi" unwrap "$theater" -o "$work/x.gltf"
expect 2 "too small for" "$surimi" bake "$theater" --size 64
expect 2 "Nobody" "$surimi" bake "$theater" --monitor Nobody
expect 2 "" "$surimi" bake "$theater" --monitor Monitor_R=X
printf 'sampels = 3\n' >"$work/bad.toml"
expect 2 'did you mean "samples"' "$surimi" bake "$theater" --config "$work/bad.toml"
printf 'error = 0.01\nquality = "draft"\n' >"$work/bad.toml"
expect 2 "bad.toml: quality and error" "$surimi" bake "$theater" --config "$work/bad.toml"
printf 'samples = "many"\n' >"$work/bad.toml"
expect 2 "bad.toml:1" "$surimi" bake "$theater" --config "$work/bad.toml"
printf 'size = [\n' >"$work/bad.toml"
expect 2 "bad.toml" "$surimi" bake "$theater" --config "$work/bad.toml"
printf '[[texel_scale]]\nnode = "Flor*"\nscale = 2\n' >"$work/bad.toml"
expect 2 'node "Flor*"' "$surimi" bake "$theater" --config "$work/bad.toml"
printf '[[texel_scale]]\nscale = 2\n' >"$work/bad.toml"
expect 2 'needs "node" or "material"' "$surimi" bake "$theater" --config "$work/bad.toml"
printf '[[texel_scale]]\nnode = "*"\nscale = 0\n' >"$work/bad.toml"
expect 2 "bad.toml:3" "$surimi" bake "$theater" --config "$work/bad.toml"
printf '[[object]]\nnode = "Flor*"\ncasts = false\n' >"$work/bad.toml"
expect 2 'object "Flor*"' "$surimi" bake "$theater" --config "$work/bad.toml"
printf '[[object]]\nnode = "*"\ncast = false\n' >"$work/bad.toml"
expect 2 'did you mean "casts"' "$surimi" bake "$theater" --config "$work/bad.toml"
printf '[[object]]\ncasts = false\n' >"$work/bad.toml"
expect 2 'needs "node"' "$surimi" bake "$theater" --config "$work/bad.toml"
printf '[[object]]\nnode = "*"\n' >"$work/bad.toml"
expect 2 'needs one of casts' "$surimi" bake "$theater" --config "$work/bad.toml"
printf '[[object]]\nnode = "*"\ncasts = "no"\n' >"$work/bad.toml"
expect 2 "bad.toml:3" "$surimi" bake "$theater" --config "$work/bad.toml"
expect 2 'did you mean "clear"' "$surimi" bake "$theater" --glass cleer
expect 2 "glass must be" env SURIMI_GLASS=milk "$surimi" inspect "$theater"
expect 2 "no camera is called" "$surimi" preview "$theater" -o "$work/x.png" --camera Nowhere
expect 2 "must be a .png or .exr" "$surimi" preview "$theater" -o "$work/x.bmp"

# 3: the scene
expect 3 "missing.glb" "$surimi" inspect "$work/missing.glb"
head -c 1000 "$theater" >"$work/short.glb"
expect 3 "short.glb" "$surimi" bake "$work/short.glb" -o "$work/short"
check test ! -e "$work/short"
printf '{"asset":{"version":"2.0"},"extensionsRequired":["XX_none"],"extensionsUsed":["XX_none"]}' >"$work/extension.gltf"
expect 3 "XX_none" "$surimi" inspect "$work/extension.gltf"

# 4: nothing to bake
printf '{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"name":"Empty"}]}' >"$work/empty.gltf"
expect 4 "--monitor" "$surimi" bake "$work/empty.gltf" -o "$work/empty"
check test ! -e "$work/empty"

# 6: cannot write
: >"$work/file"
expect 6 "" "$surimi" bake "$theater" --size 128 --quality draft --quiet -o "$work/file/out"

# A bake: all files, the input as it was, the same bytes again with another number of threads
before=$(sha256sum <"$theater")
expect 0 "home-theater.baked.glb" "$surimi" bake "$theater" --size 128 --quality draft --audit 20 -o "$work/out" --threads 1
check grep -q "estimated error: .* within 0.02, RMS .*; audit of 20: RMSE" "$work/stderr"
check test "$before" = "$(sha256sum <"$theater")"
for name in visibility.exr visibility.png lightmaps.exr baked.glb visibility.json; do
    check test -s "$work/out/home-theater.$name"
done
check test -z "$(find "$work/out" -name '*tmp*')"
expect 0 "" "$surimi" bake "$theater" --size 128 --quality draft --audit 20 -o "$work/again" --threads 3 --quiet
check test ! -s "$work/stderr"
# FIRST SECOND: the files of both bakes are the same, the manifest up to what it says of the run.
expect_same_bake() {
    for name in visibility.exr visibility.png lightmaps.exr baked.glb; do
        check cmp "$1/home-theater.$name" "$2/home-theater.$name"
    done
    check grep -q '^  "run"' "$1/home-theater.visibility.json"
    check cmp <(sed '/^  "run"/,$d' "$1/home-theater.visibility.json") <(sed '/^  "run"/,$d' "$2/home-theater.visibility.json")
}
expect_same_bake "$work/out" "$work/again"
for method in "--method split" "--method scanline" "--method mc --error 0.05" "--method mc --samples 8" "--exact --error 0.1"; do
    read -ra options <<<"$method"
    for threads in 1 3; do
        expect 0 "" "$surimi" bake "$theater" --size 128 --quiet "${options[@]}" --threads $threads -o "$work/threads-$threads"
    done
    expect_same_bake "$work/threads-1" "$work/threads-3"
done

# The evidence in the manifest: every measured texel is in the histogram and has a method
node -e '
    const manifest = JSON.parse(require("fs").readFileSync(process.argv[1]));
    const { promise, errorHistogram, methods, audit } = manifest.evidence.R;
    const sum = (numbers) => numbers.reduce((a, b) => a + b, 0);
    const measured = sum(Object.entries(methods).filter(([name]) => name != "none").map(([, method]) => method.texels));
    const holds = promise.error === 0.02 && promise.kept === (promise.breaches.length === 0) && measured > 1000 &&
        measured === manifest.texels.R.covered && sum(errorHistogram.texels) === measured &&
        errorHistogram.below.length === errorHistogram.texels.length && audit.texels === 20 &&
        sum(Object.values(methods).map((method) => method.rays)) === manifest.rays["light from Monitor_R"] &&
        manifest.settings.error === 0.02 && manifest.settings.audit === 20 && manifest.run.monitors.R.querySeconds >= 0;
    process.exit(holds ? 0 : 1)' "$work/out/home-theater.visibility.json" || fail "evidence of the manifest"
expect 0 "" "$surimi" bake "$theater" --size 128 --atlases 2 --quality draft --audit 21 --quiet -o "$work/pages"
node -e '
    const { audit } = JSON.parse(require("fs").readFileSync(process.argv[1])).evidence.R;
    const texels = audit.pages.map((page) => page.texels);
    process.exit(texels.length === 2 && texels[0] > 0 && texels[1] > 0 && texels[0] + texels[1] === audit.texels &&
        audit.texels === 21 ? 0 : 1)' "$work/pages/home-theater.visibility.json" || fail "audits of two pages"
checks=$((checks + 2))

# 5: sixteen rays are not enough for an error of 0.0001; without --strict that is a warning
expect 5 "Monitor_R" "$surimi" bake "$theater" --size 128 --method mc --samples 16 --error 0.0001 --strict --quiet -o "$work/strict"
check test -s "$work/strict/home-theater.visibility.json"
expect 0 "the error asked for is not reached" "$surimi" bake "$theater" --size 128 --method mc --samples 16 --error 0.0001 -o "$work/strict"
check grep -q '"kept": false' "$work/strict/home-theater.visibility.json"
expect 0 "" "$surimi" bake "$theater" --size 128 --exact --error 1 --strict --quiet -o "$work/strict"
check grep -q '"kept": true' "$work/strict/home-theater.visibility.json"
check node "$here/validate_glb.mjs" "$theater" "$work/out/home-theater.baked.glb"

# Settings: file under environment under command line; what is printed can be read back
printf 'method = "mc"\nsamples = 7\nsize = 96\n[[texel_scale]]\nnode = "*"\nscale = 0.5\n' >"$work/some.toml"
expect 0 "samples = 7 " "$surimi" bake "$theater" --config "$work/some.toml" --print-config
expect 0 "samples = 8 " env SURIMI_SAMPLES=8 "$surimi" bake "$theater" --config "$work/some.toml" --print-config
expect 0 "samples = 9 " env SURIMI_SAMPLES=8 "$surimi" bake "$theater" --config "$work/some.toml" --samples 9 --print-config
expect 0 "samples = 8 " env SURIMI_SAMPLES=8 "$surimi" bake "$theater" --method mc --print-config
expect 0 "samples = 0 " "$surimi" bake "$theater" --config "$work/some.toml" --method split --print-config
expect 0 "error = 0.001 " env SURIMI_QUALITY=high "$surimi" bake "$theater" --print-config
expect 0 "error = 0.03 " env SURIMI_QUALITY=high "$surimi" bake "$theater" --error 0.03 --print-config
expect 0 "exact = true " env SURIMI_EXACT=1 "$surimi" bake "$theater" --print-config
expect 0 "exact = true " "$surimi" bake "$theater" --quality reference --print-config
expect 0 "time = 30 " "$surimi" bake "$theater" --time 30 --print-config
expect 0 "uv = " env SURIMI_SAMPLES=8 "$surimi" unwrap "$theater" --print-config # which gathers nothing
"$surimi" bake "$theater" --config "$work/some.toml" --monitor 'Monitor_*=B' --print-config >"$work/effective.toml"
expect 0 'scale = 0.5' "$surimi" bake "$theater" --config "$work/effective.toml" --print-config
expect 0 'channel = "B"' "$surimi" bake "$theater" --config "$work/effective.toml" --print-config
check diff <("$surimi" bake "$theater" --config "$work/effective.toml" --print-config) "$work/effective.toml"
printf 'uv = "auto"\nmips = 1\natlases = 2\nstretch = 3\nuv-quality = "high"\n' >"$work/uv.toml"
"$surimi" unwrap "$theater" --config "$work/uv.toml" --print-config >"$work/effective.toml"
for line in 'uv = "auto"' 'mips = 1 ' 'atlases = 2 ' 'stretch = 3 ' 'uv-quality = "high"'; do
    check grep -qF "$line" "$work/effective.toml"
done
check diff <("$surimi" unwrap "$theater" --config "$work/effective.toml" --print-config) "$work/effective.toml"
for setting in UV=existing MIPS=2 ATLASES=3 STRETCH=2.5 UV_QUALITY=draft; do
    expect 0 "${setting#*=}" env "SURIMI_$setting" "$surimi" unwrap "$theater" --config "$work/uv.toml" --print-config
done
expect 0 'mips = 4 ' env SURIMI_MIPS=2 "$surimi" unwrap "$theater" --config "$work/uv.toml" --mips 4 --print-config

# Casters and receivers: settings that can be read back, what is announced, nothing left
printf 'glass = "clear"\n[[object]]\nnode = "Sofa*"\ncasts = false\n[[object]]\nnode = "Rug"\nexclude = true\n' >"$work/roles.toml"
"$surimi" bake "$theater" --config "$work/roles.toml" --print-config >"$work/effective.toml"
for line in 'glass = "clear"' 'node = "Sofa*"' 'casts = false' 'exclude = true'; do
    check grep -qF "$line" "$work/effective.toml"
done
check diff <("$surimi" bake "$theater" --config "$work/effective.toml" --print-config) "$work/effective.toml"
expect 0 'glass = "block"' "$surimi" bake "$theater" --config "$work/roles.toml" --glass block --print-config
expect 2 'there is no fix "acne"' "$surimi" bake "$theater" --without acne
expect 0 'without = ["inside", "seams"]' "$surimi" bake "$theater" --without seams --without inside --print-config
expect 0 'without = ["fill"]' env SURIMI_WITHOUT=fill "$surimi" bake "$theater" --print-config
expect 0 'glass = "clear"' env SURIMI_GLASS=clear "$surimi" bake "$theater" --print-config
expect 0 "block light like walls" "$surimi" inspect "$theater"
expect 0 "casts no shadow (glass)" "$surimi" inspect "$theater" --glass clear
printf '[[object]]\nnode = "*"\nreceives = false\n' >"$work/roles.toml"
expect 4 "nothing is left to bake" "$surimi" bake "$theater" --config "$work/roles.toml" -o "$work/roles"
printf '[[object]]\nnode = "mesh*/1?"\nexclude = true\n' >"$work/roles.toml"
"$surimi" inspect "$theater" --config "$work/roles.toml" --json | node -e '
    const { roles } = JSON.parse(require("fs").readFileSync(0));
    process.exit(roles.length > 5 && roles.every((role) => role.excluded && role.why.includes("[[object]]")) ? 0 : 1)' ||
    fail "roles of inspect --json"
expect 0 "left out of the bake by [[object]]" "$surimi" bake "$theater" --config "$work/roles.toml" --size 128 --quality draft -o "$work/roles"
check node "$here/validate_glb.mjs" "$theater" "$work/roles/home-theater.baked.glb"
node -e '
    const { nodes, settings } = JSON.parse(require("fs").readFileSync(process.argv[1]));
    const surfaces = nodes.flatMap((node) => node.surfaces);
    process.exit(surfaces.length > 5 && !surfaces.some((name) => /\/1.$/.test(name)) && settings.object[0].exclude &&
        settings.glass === "block" ? 0 : 1)' "$work/roles/home-theater.visibility.json" || fail "roles in the manifest"
checks=$((checks + 2))
# A monitor that the configuration describes
printf '[[monitor]]\nname = "Wall"\nchannel = "G"\ncenter = [0, 1.5, 0]\nhalf_u = [0.5, 0, 0]\nhalf_v = [0, 0.3, 0]\n' >"$work/wall.toml"
expect 0 "Wall" "$surimi" bake "$theater" --config "$work/wall.toml" --size 128 --quality draft -o "$work/wall"
check node "$here/validate_glb.mjs" "$theater" "$work/wall/home-theater.baked.glb"
expect 0 "Wall" "$surimi" inspect "$work/wall/home-theater.baked.glb"

# Baking into the UVs of a bake gives the same map again
expect 0 "" "$surimi" bake "$work/out/home-theater.baked.glb" --uv existing --size 128 --quality draft -o "$work/existing" --quiet
expect 3 "TEXCOORD_1" "$surimi" bake "$theater" --uv existing --size 128 -o "$work/none"

# Inspecting and looking
expect 0 "Monitor_R" "$surimi" inspect "$theater"
"$surimi" inspect "$theater" --json | node -e '
    const report = JSON.parse(require("fs").readFileSync(0));
    process.exit(report.monitors.length === 1 && report.monitors[0].channel === "R" && report.triangles > 7000 ? 0 : 1)' ||
    fail "inspect --json"
checks=$((checks + 1))
for show in lit visibility unshadowed shadowed uv texels normals; do
    expect 0 "$show.png" "$surimi" preview "$work/out/home-theater.baked.glb" -o "$work/$show.png" --show $show --size 64 36 --samples 1
    check test -s "$work/$show.png"
done
expect 0 "" "$surimi" preview "$work/out/home-theater.baked.glb" --map "$work/out/home-theater.visibility.exr" \
    -o "$work/lit.exr" --camera 0 1.5 0 --look-at 0 1 -3 --fov 60 --exposure 2 --size 64 36 --quiet
expect 0 '"exposure"' "$surimi" preview "$work/out/home-theater.baked.glb" -o "$work/json.png" --json --camera auto --size 64 36 --samples 1
expect 0 "no visibility map" "$surimi" preview "$theater" -o "$work/plain.png" --size 64 36 --samples 1
expect 0 "no monitor faces or reaches them" "$surimi" unwrap "$theater" -o "$work/uv.glb" --size 256
expect 2 "is the input" "$surimi" unwrap "$work/uv.glb" -o "$work/uv.glb" --size 256

# Unwrapping into a folder: the scene, three pictures, the numbers, which do not depend on the number of threads
expect 0 "home-theater.stretch.png" "$surimi" unwrap "$theater" -o "$work/unwrap/" --size 256 --threads 1
expect 0 '"densityEfficiency"' "$surimi" unwrap "$theater" -o "$work/unwrap-again/" --size 256 --threads 3 --json
check diff <(head -n -4 "$work/stdout") <(head -n -4 "$work/unwrap/home-theater.unwrap.json") # all but the seconds
for name in unwrapped.glb charts.png density.png stretch.png; do
    check test -s "$work/unwrap/home-theater.$name"
    check cmp "$work/unwrap/home-theater.$name" "$work/unwrap-again/home-theater.$name"
done
check cmp "$work/unwrap/home-theater.unwrapped.glb" "$work/uv.glb"
expect 0 "home-theater.charts.png" env -C "$work" "$surimi" unwrap "$theater" --size 256 --quiet
check test -s "$work/uv/home-theater.unwrap.json"

# Existing UVs: fit at their size; unfit at a smaller one, with a picture and a size that helps; auto chooses
expect 0 "" "$surimi" unwrap "$work/uv.glb" --uv existing --size 256 -o "$work/existing.glb" --quiet
expect 3 "256 x 256 texels are enough" "$surimi" unwrap "$work/uv.glb" --uv existing --size 128 -o "$work/unfit/x.glb"
check test -s "$work/unfit/uv.uv-faults.png"
check test ! -e "$work/unfit/x.glb"
expect 3 "out-unfit/uv.uv-faults.png" "$surimi" bake "$work/uv.glb" --uv existing --size 128 -o "$work/out-unfit"
expect 0 "the existing UVs are used" "$surimi" unwrap "$work/uv.glb" --uv auto --size 256 -o "$work/auto.glb"
expect 0 "new charts are made" "$surimi" unwrap "$work/uv.glb" --uv auto --size 128 -o "$work/auto.glb"
expect 0 '"reason": "TEXCOORD_1' "$surimi" unwrap "$theater" --uv auto --size 128 -o "$work/auto.glb" --json
expect 0 "less than the gutter of 8" "$surimi" unwrap "$work/uv.glb" --uv existing --size 256 --gutter 8 -o "$work/existing.glb"

# What accuracy costs: four files and words, or numbers
expect 0 "Recommended: surimi bake home-theater.glb --error" "$surimi" study "$theater" --size 128 --texels 8 --reference 256 -o "$work/study" --quiet
for name in svg csv json md; do
    check test -s "$work/study/home-theater.study.$name"
done
check test "$(find "$work/study" -type f | wc -l)" == 4
"$surimi" study "$theater" --size 128 --texels 8 --reference 256 --seed 3 --json --quiet -o "$work/study" >"$work/study.json"
check node -e 'process.exit(JSON.parse(require("fs").readFileSync(process.argv[1])).techniques.length === 12 ? 0 : 1)' "$work/study.json"
expect 2 "texels must be" "$surimi" study "$theater" --texels 0
expect 2 "reference must be" "$surimi" study "$theater" --reference 16
expect 2 "did you mean --texels" "$surimi" study "$theater" --texel 8
expect 6 "cannot be written" "$surimi" study "$theater" --size 128 -o "$work/study.json"

# Plans: words, numbers, and beside the bake that came of it
expect 0 "foretold" "$surimi" plan "$theater" --size 128 --quality draft --quiet
check grep -q "alpha filter *off" "$work/stdout"
check grep -q "audit of Monitor_R *off .*--audit N" "$work/stdout"
expect 0 "" "$surimi" bake "$theater" --size 128 --quality draft --quiet -o "$work/planned"
expect 0 "plan against bake" "$surimi" plan "$theater" --size 128 --quality draft --quiet --compare "$work/planned/home-theater.visibility.json"
expect 0 "had other settings" "$surimi" plan "$theater" --size 128 --error 0.03 --json --compare "$work/planned/home-theater.visibility.json"
check node -e '
    const { monitors, stages, run } = JSON.parse(require("fs").readFileSync(process.argv[1]));
    const holds = monitors[0].reach.length > 3 && stages.some(({ stage, runs }) => stage === "unwrap" && runs) &&
        run.seconds > 0 && run.memory.peak > 0 && run.comparison.rays.ratio > 0;
    process.exit(holds ? 0 : 1)' "$work/stdout"
expect 3 "cannot be read" "$surimi" plan "$theater" --compare "$work/missing.json"
expect 3 "is no manifest" "$surimi" plan "$theater" --compare "$work/some.toml"
expect 0 "error = 0.02" "$surimi" plan "$theater" --quality draft --print-config

# --time: too little is said; the error of the manifest gives the same bytes
expect 0 "so the time is exceeded" "$surimi" bake "$theater" --size 128 --time 0.001 -o "$work/timed"
check grep -q -- "--time 0.001: error 0.05 " "$work/stderr"
expect 0 "" "$surimi" bake "$theater" --size 128 --error 0.05 --quiet -o "$work/timed-again"
for name in visibility.exr lightmaps.exr baked.glb; do
    check cmp "$work/timed/home-theater.$name" "$work/timed-again/home-theater.$name"
done
check grep -q '"error": 0.05' "$work/timed/home-theater.visibility.json"

# Comparing
expect 0 "FLIP           0 " "$surimi" compare "$work/out/home-theater.visibility.exr" "$work/again/home-theater.visibility.exr"
expect 5 "rmse is" "$surimi" compare "$work/lit.png" "$work/unshadowed.png" --fail-above 1e-6 --metric rmse
expect 5 "flip is" "$surimi" compare "$work/lit.png" "$work/unshadowed.png" --fail-above 1e-6 --metric flip
expect 0 "FLIP, black 0 to yellow 1" "$surimi" compare "$work/lit.png" "$work/unshadowed.png" --metric flip --fail-above 1 -o "$work/heat.png"
check test -s "$work/heat.png"
expect 0 "absolute difference" "$surimi" compare "$work/lit.png" "$work/unshadowed.png" -o "$work/heat.png"
# The PNG is the map in sRGB codes, which are at most 1 / 255 / 2 * 2.3 (the curve's slope at white) = 0.0045 off.
expect 0 "not_finite" "$surimi" compare "$work/out/home-theater.visibility.png" "$work/out/home-theater.visibility.exr" --json --metric largest --fail-above 0.0048
expect 2 "64 x 36 and 128 x 128" "$surimi" compare "$work/lit.png" "$work/out/home-theater.visibility.exr"
expect 2 "choose one" "$surimi" compare "$work/out/home-theater.lightmaps.exr" "$work/out/home-theater.lightmaps.exr"
expect 2 "Nothing" "$surimi" compare "$work/lit.png" "$work/lit.png" --channel Nothing
expect 0 "RMSE           0" "$surimi" compare "$work/lit.png" "$work/lit.png" --channel G
expect 2 "must be a .png" "$surimi" compare "$work/lit.png" "$work/lit.png" -o "$work/heat.exr"
expect 3 "missing.png" "$surimi" compare "$work/missing.png" "$work/lit.png"

# Light without a new bake, other models, explanations, and the comparison with brute force
baked=$work/out/home-theater.baked.glb
"$surimi" preview "$baked" -o "$work/red.exr" --light Monitor_R=1,0,0 --exposure 0 --size 32 18 --samples 1 --quiet >/dev/null
"$surimi" preview "$baked" -o "$work/green.exr" --light Monitor_R=0,1,0 --exposure 0 --size 32 18 --samples 1 --quiet >/dev/null
if cmp -s "$work/red.exr" "$work/green.exr"; then fail "--light changes nothing"; fi
expect 0 "" "$surimi" preview "$baked" -o "$work/off.png" --light Monitor_R=0 --size 32 18 --samples 1
expect 2 "no monitor is called" "$surimi" preview "$baked" -o "$work/x.png" --light Nobody=1
expect 2 "is not a number" "$surimi" preview "$baked" -o "$work/x.png" --light Monitor_R=1,blue,0
expect 0 "" "$surimi" preview "$baked" -o "$work/picture.png" --picture "Monitor_R=$work/lit.png" --size 32 18 --samples 1
expect 3 "missing.png" "$surimi" preview "$baked" -o "$work/x.png" --picture "Monitor_R=$work/missing.png" --size 32 18
for model in exact kanikama three reference; do
    expect 0 "$model.png" "$surimi" preview "$baked" -o "$work/$model.png" --model $model --light-samples 2 --size 32 18 --samples 1
done
for source in none baked stochastic reference; do
    expect 0 "$source.png" "$surimi" preview "$baked" -o "$work/$source.png" --visibility $source --light-samples 2 --size 32 18 --samples 1
done
expect 0 "map reads" "$surimi" preview "$baked" -o "$work/explained.png" --explain --size 32 18 --samples 1
expect 0 "whole picture" "$surimi" preview "$baked" -o "$work/compared.png" --compare --reference-samples 4 --progressive --size 32 18 --samples 2
for name in compared.png compared.reference.png compared.difference.png; do
    check test -s "$work/$name"
done
expect 0 '"referenceNoise"' "$surimi" preview "$baked" -o "$work/compared.png" --compare --json --reference-samples 2 --size 32 18 --samples 1
expect 2 "--compare is for" "$surimi" preview "$baked" -o "$work/x.png" --compare --show diffuse

# Exports, of a bake's files and with a bake
expect 2 'did you mean godot?' "$surimi" export "$work/out" goddot
expect 2 'did you mean kanikama?' "$surimi" bake "$theater" --export kanikma -o "$work/never"
check test ! -e "$work/never"
expect 3 "" "$surimi" export "$work/nowhere" three
expect 0 "export/kanikama/README.md" "$surimi" export "$work/out" kanikama three
check oiiotool "$work/out/home-theater.visibility.exr" "$work/out/export/kanikama/home-theater.visibility.exr" --diff
expect 0 "export/godot/surimi.gdshader" "$surimi" bake "$theater" --size 128 --quality draft --quiet --export godot,ltcgi -o "$work/exported"
check test -z "$(find "$work/exported" -name '*tmp*')"
check test -s "$work/exported/home-theater.report.html"

# Help: the options of every day on one screen of 100 columns, all of them on demand
check test "$("$surimi" bake --help | wc -l)" -le 45
check test "$(COLUMNS=100 "$surimi" bake --help-all | wc -L)" -le 100
expect 0 "more options: surimi bake --help-all" "$surimi" bake --help
expect 0 "--supersample" "$surimi" bake --help-all
expect 0 "doctor" "$surimi" --help

# Completion: what bash would offer
complete_words() { # WORD...: the last one is being typed
    bash -c 'source "$1"; shift; COMP_WORDS=(surimi "$@"); COMP_CWORD=$#; _surimi; echo "${COMPREPLY[@]}"' _ "$work/surimi.bash" "$@"
}
"$surimi" completion bash >"$work/surimi.bash"
check test "$(complete_words pre)" = preview
check test "$(complete_words bake --qu)" = "--quiet --quality"
check test "$(complete_words bake --quality d)" = draft
check test "$(complete_words bake --progress '')" = "auto bar lines json none"
check test -z "$(complete_words bake room)"     # files are bash's own
check test -z "$(complete_words bake --size '')" # so is what is no list of words
expect 0 "#compdef surimi" "$surimi" completion zsh
expect 0 "__fish_seen_subcommand_from bake' -l quality" "$surimi" completion fish
expect 2 "bash,zsh,fish" "$surimi" completion powershell
for shell in zsh fish; do
    "$surimi" completion $shell >"$work/surimi.$shell"
    command -v $shell >/dev/null && check $shell -n "$work/surimi.$shell"
done

# The health of a machine and of a bake
expect 0 "ok" "$surimi" doctor
expect 0 '"instructionSet"' "$surimi" doctor --json
expect 1 "FAILED" env TMPDIR="$work/no/such" "$surimi" doctor
expect 0 "home-theater.baked.glb" "$surimi" validate "$work/out"
expect 0 '"faults": []' "$surimi" validate "$work/out/home-theater.visibility.json" --json
expect 2 "no NAME.visibility.json" "$surimi" validate "$work/out/.."
expect 3 "is no manifest" "$surimi" validate "$theater"
cp -r "$work/out" "$work/damaged"
printf x >>"$work/damaged/home-theater.visibility.png"
rm "$work/damaged/home-theater.lightmaps.exr"
expect 3 "visibility.png: is not what the bake wrote" "$surimi" validate "$work/damaged"
expect 3 "lightmaps.exr: is missing" "$surimi" validate "$work/damaged"
# Lightmaps of another baker: those of a bake are as good
for light in shadowed unshadowed; do
    oiiotool "$work/out/home-theater.lightmaps.exr" --ch "R=Monitor_R.$light,G=Monitor_R.$light,B=Monitor_R.$light" -d float -o "$work/$light.exr"
    oiiotool "$work/$light.exr" --mulc 0.2 -d uint8 -o "$work/$light.png"
done
expect 0 "ratio.visibility.png" "$surimi" ratio --red "$work/shadowed.exr" "$work/unshadowed.exr" -o "$work/ratio" --validity "$work/validity.png"
expect 0 '"coverage": "light"' "$surimi" ratio --green "$work/shadowed.exr" "$work/unshadowed.exr" -o "$work/ratio-green" --json
expect 0 "RMSE" "$surimi" compare "$work/ratio-green.visibility.exr" "$work/ratio.visibility.exr" --fail-above 1
expect 0 "blue" "$surimi" compare "$work/ratio.visibility.exr" "$work/out/home-theater.visibility.exr" --channel R --mask "$work/validity.png" --signed -o "$work/signed.png" --metric mean --fail-above 0.02
expect 2 "no sign" "$surimi" compare "$work/lit.png" "$work/lit.png" --signed --metric flip -o "$work/nothing.png"
expect 0 "noise" "$surimi" ratio --linear --red "$work/shadowed.png" "$work/unshadowed.png" -o "$work/ratio-png"
expect 0 "ratio-kanikama.visibility.exr" "$surimi" ratio --kanikama-compat --red "$work/shadowed.exr" "$work/unshadowed.exr" -o "$work/ratio-kanikama"
expect 5 "covered texels" "$surimi" ratio --red "$work/unshadowed.exr" "$work/shadowed.exr" -o "$work/ratio-swapped" --fail-above 1
expect 2 "--red" "$surimi" ratio -o "$work/nothing"
expect 2 "one size" "$surimi" ratio --red "$work/shadowed.exr" "$work/picture.png" -o "$work/nothing"
expect 3 "missing.exr" "$surimi" ratio --red "$work/missing.exr" "$work/shadowed.exr" -o "$work/nothing"
expect 6 "is an input" "$surimi" ratio --red "$work/ratio.visibility.exr" "$work/unshadowed.exr" -o "$work/ratio"
check test -z "$(find "$work" -name 'nothing*')"

# 130: Ctrl-C leaves nothing behind
"$surimi" bake "$theater" --size 2048 --method mc --samples 4096 -o "$work/interrupted" --quiet 2>"$work/stderr" &
sleep 3
kill -INT $!
wait $!
code=$?
[[ $code == 130 ]] || fail "exit code $code after an interrupt in place of 130"
check test -z "$(find "$work/interrupted" -type f 2>/dev/null)"
checks=$((checks + 1))

"$surimi" unwrap "$theater" --size 2048 --threads 1 -o "$work/interrupted-uv" --progress lines 2>"$work/stderr" &
for ((i = 0; i < 200; ++i)); do
    grep -q "^charts" "$work/stderr" && break # from here on it listens
    sleep 0.05
done
kill -INT $!
wait $!
code=$?
[[ $code == 130 ]] || fail "exit code $code after an interrupt of an unwrap in place of 130"
check test -z "$(find "$work/interrupted-uv" -type f 2>/dev/null)"
checks=$((checks + 1))

echo "$((checks - failures)) of $checks checks of the command line passed"
((failures == 0 && checks > 50))
