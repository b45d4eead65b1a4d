#!/usr/bin/env bash
# Unwraps every scene of a folder at 1024 x 1024 and judges the result with an independent tool; exits 1 when one is
# unfit: unwraps.sh SURIMI SCENES UVMETRICS
# UVMETRICS is called as `UVMETRICS FILE.glb --size 1024 1024 --padding 2 --check --quiet`.
set -uo pipefail
surimi=$1 scenes=$2 uvmetrics=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=0 good=0
for file in $(find "$scenes" \( -name '*.glb' -o -name '*.gltf' \) -not -path '*broken*' | sort); do
    name=${file#"$scenes"/}
    if ! "$surimi" unwrap "$file" -o "$work/uv.glb" --size 1024 --quiet >/dev/null 2>"$work/error"; then
        echo "no    $name: $(tail -n 1 "$work/error")"
        continue
    fi
    "$uvmetrics" "$work/uv.glb" --size 1024 1024 --padding 2 --check --quiet --csv "$work/row.csv" 2>"$work/error"
    case $? in
        0) good=$((good + 1)) && echo "good  $name" ;;
        2) echo "n/a   $name: $(tail -n 1 "$work/error")" ;;
        *) bad=$((bad + 1)) && echo "BAD   $name: $(tail -n 1 "$work/row.csv" | cut -c1-200)" ;;
    esac
done
echo "$good good, $bad bad"
((bad == 0 && good > 0))
