#!/usr/bin/env bash
# screenshot.sh SURIMI SCENES: the window of preview on a screen in memory, drawn by the processor: it shows the picture
# that the file preview writes, its controls, what options and keys switch, and leaves with the right exit code.
set -uo pipefail
surimi=$(realpath "$1")
theater=$(realpath "$2")/home-theater/home-theater.glb
if [[ ${3:-} != --on-screen ]]; then
    for tool in xvfb-run xauth xdotool oiiotool; do
        command -v $tool >/dev/null || { echo "skipped: $tool is missing; .ci/install.sh --tests installs it"; exit 77; }
    done
    exec xvfb-run -a -s "-screen 0 1600x900x24" "$0" "$1" "$2" --on-screen
fi

work=$(mktemp -d)
window=
trap '[[ -z $window ]] || kill "$window" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
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
    "$@" >stdout 2>stderr
    local got=$?
    [[ $got == "$code" ]] || fail "exit code $got in place of $code: $*: $(tail -n 2 stderr)"
    grep -qF -- "$text" stdout stderr || fail "no \"$text\" in the output of: $*: $(tail -n 3 stderr)"
}
# same A B: pixel by pixel, but for one code, by which drivers round differently.
same() { oiiotool "$1" "$2" --fail 0.0045 --warn 0.0045 --diff >/dev/null 2>&1; }
check() {
    checks=$((checks + 1))
    "$@" || fail "$*"
}
check_not() {
    checks=$((checks + 1))
    "$@" && fail "not $*"
}
picture_of() { oiiotool "$1" --cut 320x180+0+0 -o "$2"; }
panel_of() { oiiotool "$1" --cut 320x216+320+0 -o "$2"; }

expect 0 "" "$surimi" bake "$theater" --size 128 --quality draft -o out --quiet
((failures)) && exit 1
baked=out/home-theater.baked.glb
small=(--size 320 180 --samples 2 --quiet)

expect 2 "or --window" "$surimi" preview "$baked"
expect 2 "goes with --window" "$surimi" preview "$baked" -o x.png --screenshot y.png
expect 2 "goes with --screenshot" "$surimi" preview "$baked" --window --frames 3
expect 2 "not for --window" "$surimi" preview "$baked" --window --compare
"$surimi" preview "$baked" --window --screenshot x.png "${small[@]}" >stdout 2>stderr
if grep -q "has no window" stderr; then
    expect 2 "libimgui-dev" "$surimi" preview "$baked" --window
    ((failures)) && exit 1
    echo "skipped: this build has no window, and says so"
    exit 77
fi
expect 2 "write a file with -o" env -u DISPLAY -u WAYLAND_DISPLAY "$surimi" preview "$baked" --window

# What it shows is what the file preview writes, beside controls; options are its first settings
for name in lit off visibility rough; do
    case $name in
        lit) options=() ;;
        off) options=(--light Monitor_R=0) ;;
        visibility) options=(--show visibility) ;;
        rough) options=(--roughness 0.1 --model three --visibility none) ;;
    esac
    expect 0 "$name.window.png" "$surimi" preview "$baked" --window --screenshot $name.window.png "${small[@]}" "${options[@]}"
    expect 0 "$name.png" "$surimi" preview "$baked" -o $name.png "${small[@]}" "${options[@]}"
    picture_of $name.window.png $name.shown.png
    panel_of $name.window.png $name.panel.png
    check same $name.shown.png $name.png
    [[ $name == lit ]] && continue
    check_not same $name.png lit.png
    [[ $name != off ]] || check_not same $name.panel.png lit.panel.png
done
# The panel: a dark ground, light text, orange headings and ticks
statistic() { oiiotool --stats lit.panel.png | awk -v kind="$1" '$1 == "Stats" && $2 == kind ":" {print ('"$2"')}'; }
check test "$(statistic Avg '$3 + $4 + $5 > 60 && $3 + $4 + $5 < 210')" = 1
check test "$(statistic Max '$3 > 220 && $4 > 220')" = 1
check test "$(statistic StdDev '$3 > 20')" = 1
# --frames ends an unfinished picture
expect 0 "early.png" timeout 100 "$surimi" preview "$baked" --window --screenshot early.png --frames 4 \
    --model reference --light-samples 65536 "${small[@]}"

# The hand: keys switch the monitor off, then on, save, move, resize and close
"$surimi" preview "$baked" --window -o saved.png "${small[@]}" 2>window.txt &
window=$!
id=$(timeout 60 xdotool search --sync --onlyvisible --pid $window | tail -n 1)
check test -n "$id"
xdotool windowfocus "$id"
# press KEY: for longer than a frame takes.
press() {
    xdotool keydown "$1"
    sleep 0.2
    xdotool keyup "$1"
    sleep 0.2
}
# shows FILE: after a while P saves that picture.
shows() {
    for _ in $(seq 60); do
        kill -0 "$window" 2>/dev/null || return 1
        press p
        [[ -s saved.png ]] && same saved.png "$1" && return 0
    done
    return 1
}
check shows lit.png
press 1
check shows off.png
press 1
check shows lit.png
for step in "mousemove 100 100" "mousedown 1" "mousemove 120 105" "mousemove 140 110" "mouseup 1"; do
    xdotool $step # a command and its arguments
    sleep 0.3
done
press p
sleep 1
check_not same saved.png lit.png
press Home
check shows lit.png
xdotool windowsize "$id" 560 286 # a picture of 240 x 250
sleep 1
press p
sleep 1
press x
sleep 1
check test "$(oiiotool --info saved.png | grep -c '240 x  250')" = 1
check test -s saved.exr
press Escape
wait $window
code=$?
window=
check test $code = 0

echo "$checks checks, $failures failures"
((failures == 0))
