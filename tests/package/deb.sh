#!/usr/bin/env bash
# Packs the build as Debian packages: deb.sh BUILD. They hold what they should, need what they should, and run.
set -euo pipefail
build=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
    echo "FAILED: $*" >&2
    exit 1
}
(cd "$work" && cpack --config "$build/CPackConfig.cmake" -B "$work" >"$work/log" 2>&1) || { cat "$work/log"; fail "cpack"; }
program=$(echo "$work"/surimi_*.deb)
development=$(echo "$work"/libsurimi-dev_*.deb)
[[ -f $program && -f $development ]] || fail "no packages: $(ls "$work")"

needs=$(dpkg-deb -f "$program" Depends)
for library in libembree3 libopenimageio2.4 libtbb12 libfmt9 libc6; do
    [[ $needs == *$library* ]] || fail "the program does not need $library: $needs"
done
[[ $needs != *-dev* ]] || fail "the program needs a -dev package: $needs"
dpkg-deb -c "$program" >"$work/files"
for file in usr/bin/surimi usr/share/man/man1/surimi.1 usr/share/man/man1/surimi-bake.1 \
    usr/share/bash-completion/completions/surimi usr/share/zsh/vendor-completions/_surimi \
    usr/share/fish/vendor_completions.d/surimi.fish usr/share/doc/surimi/LICENSE; do
    grep -q "/$file" "$work/files" || fail "the program's package has no $file"
done
grep -q "usr/include" "$work/files" && fail "the program's package has headers"
dpkg-deb -c "$development" >"$work/headers"
grep -q "include/surimi/runtime/map/visibility_map.h" "$work/headers" || fail "no headers in libsurimi-dev"
# Each command has its page, and none is empty.
dpkg-deb -x "$program" "$work/root"
for command in $("$work/root/usr/bin/surimi" --help | awk '/^Subcommands/ {on = 1; next} /^$/ {on = 0} on && /^  [a-z]/ {print $1}'); do
    [[ $(wc -l <"$work/root/usr/share/man/man1/surimi-$command.1") -gt 10 ]] || fail "no page of surimi $command"
done
"$work/root/usr/bin/surimi" doctor
# Nothing is missing that apt could not install.
if ((EUID == 0)); then
    apt-get install --simulate -qq "$program" >"$work/apt" 2>&1 || { cat "$work/apt"; fail "apt cannot install it"; }
fi
echo "packages hold what they should"
