#!/usr/bin/env bash
# How far the maps of real rooms are from an independent oracle, before and after, at the points that can be seen
# (visible_points, which has to be built beside SURIMI_AFTER), as rows of a Markdown table:
# artefact_figures.sh SURIMI_BEFORE SURIMI_AFTER SCENES ORACLE OUT
# One program twice compares settings: BEFORE_OPTIONS='--without covers,inside,terminator,fill,seams'. ROOMS names the
# rooms (SCENES/ROOM/ROOM.glb), BAKE_OPTIONS the settings of both in place of --size 1024 --quality medium (classroom:
# draft), SAMPLING the oracle's points, seed and side. Bakes stay in OUT/before/ROOM and OUT/after/ROOM; those that are
# there are not made again.
# ORACLE is called as `ORACLE points BAKED.glb MONITORS POINTS SEED SIDE` and as `ORACLE check BAKED.glb MAP.exr ..`,
# with ORACLE_DUMP=1 for a line a point.
set -euo pipefail
surimi_before=$1 surimi_after=$2 scenes=$3 oracle=$4 out=$5
read -ra sampling <<<"${SAMPLING:-4000 7 24}" # points, seed, samples a side of a panel's triangle
visible_points=$(dirname "$surimi_after")/visible_points

# bake WHEN SURIMI ROOM [OPTIONS]: nothing where there is a map already.
bake() {
    local quality=medium folder=$out/$1/$3
    [[ $3 == classroom ]] && quality=draft
    [[ -f $folder/$3.visibility.json ]] && return
    # shellcheck disable=SC2086 # several options
    "$2" bake "$scenes/$3/$3.glb" -o "$folder" --quiet ${BAKE_OPTIONS:---size 1024 --quality $quality} ${4:-} >/dev/null
}

echo "| room, monitor | | points seen | mean abs. error | RMSE | RMSE by light | 99 % | largest | wrong by half, opposite, of plain | RMSE of all points | texels inside | seam jumps: 99 %, largest |"
echo "|---|---|--:|--:|--:|--:|--:|--:|---|--:|--:|---|"
for room in ${ROOMS:-home-theater garage living-room classroom veach-ajar}; do
    bake before "$surimi_before" "$room" "${BEFORE_OPTIONS:-}"
    bake after "$surimi_after" "$room"
    monitors=$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).monitors.map(m => m.name).join()' \
        "$out/after/$room/$room.visibility.json")
    width=$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).map.width' "$out/after/$room/$room.visibility.json")
    "$oracle" points "$out/after/$room/$room.baked.glb" "$monitors" "${sampling[@]}" >"$out/$room.points.csv"
    "$visible_points" "$out/after/$room/$room.baked.glb" "$width" <"$out/$room.points.csv" >"$out/$room.visible.txt"
    for when in before after; do
        map=$out/$when/$room/$room
        ORACLE_DUMP=1 "$oracle" check "$map.baked.glb" "$map.visibility.exr" "$monitors" "${sampling[@]}" \
            2>"$out/$room.$when.csv" >"$out/$room.$when.txt"
    done
    node - "$room" "$out" <<'JS'
const fs = require("fs"), [room, out] = process.argv.slice(2);
const lines = file => fs.readFileSync(`${out}/${file}`, "utf8").trim().split("\n");
const seen = lines(`${room}.visible.txt`).map(Number);
const points = lines(`${room}.points.csv`).map(line => line.split(",").map(Number));
const sum = list => list.reduce((total, x) => total + x, 0);
const rmse = (found, weight = () => 1) =>
    Math.sqrt(sum(found.map(p => weight(p) * p.error * p.error)) / sum(found.map(weight)));
// name,U,V,map,error,x,y,z of each point that monitor m can light, in the order of the points
function errors(dump, m, next) {
    const found = [];
    points.forEach((point, i) => {
        if (point[10 + 2 * m] < 1e-5) return;
        const [truth, value, error, ...place] = (dump[next.line++] ?? "").split(",").slice(-6).map(Number);
        if (!place.every((x, axis) => Math.abs(x - point[4 + axis]) < 2e-3))
            throw new Error(`${room}: the points of the two maps differ at line ${next.line}`);
        found.push({seen: seen[i] === 1, light: point[10 + 2 * m], truth, value, error: Math.abs(error)});
    });
    return found;
}
const after = JSON.parse(fs.readFileSync(`${out}/after/${room}/${room}.visibility.json`));
for (const when of ["before", "after"]) {
    const dump = lines(`${room}.${when}.csv`), next = {line: 0};
    const manifest = JSON.parse(fs.readFileSync(`${out}/${when}/${room}/${room}.visibility.json`));
    after.monitors.forEach((monitor, m) => {
        const all = errors(dump, m, next), visible = all.filter(p => p.seen);
        const sorted = visible.map(p => p.error).sort((a, b) => a - b);
        const plain = visible.filter(p => p.truth <= 0.05 || p.truth >= 0.95);
        const half = plain.filter(p => (p.truth <= 0.05 ? p.value > 0.5 : p.value < 0.5)).length;
        const opposite = plain.filter(p => (p.truth <= 0.05 ? p.value >= 0.95 : p.value <= 0.05)).length;
        // What seams would be without stitching is what they are before: of the same charts, and by the same places.
        const seams = after.evidence[monitor.channel].seams;
        const jumps = seams && (when === "before" ? seams.jumpsBefore : seams.jumpsAfter);
        console.log(`| ${room} ${monitor.channel} | ${when} | ${visible.length} | ` +
            `${(sum(sorted) / sorted.length).toFixed(4)} | ${rmse(visible).toFixed(4)} | ` +
            `${rmse(visible, p => p.light).toFixed(4)} | ` +
            `${sorted[Math.floor(0.99 * sorted.length)].toFixed(3)} | ${sorted.at(-1).toFixed(3)} | ` +
            `${half}, ${opposite} of ${plain.length} | ${rmse(all).toFixed(4)} | ` +
            `${manifest.texels[monitor.channel].inside ?? ""} | ` +
            `${jumps ? `${jumps.percentile99.toFixed(3)}, ${jumps.largest.toFixed(2)}` : ""} |`);
    });
}
JS
done
