#!/usr/bin/env bash
# liftable.sh SOURCE: the closed forms and the map's lookup can be copied into an engine. Copies runtime/base's headers,
# runtime/ltc and runtime/map/visibility_map, and nothing else; they may include each other, GLM and the standard library,
# and compile and link with an include path alone.
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cxx=${CXX:-c++}

mkdir -p "$work"/runtime/{base,ltc,map}
cd "$source/runtime"
cp base/*.h "$work/runtime/base"
cp ltc/*.h ltc/*.cpp ltc/*.inc "$work/runtime/ltc"
cp map/visibility_map.* "$work/runtime/map"

cd "$work"
(($(find runtime -type f | wc -l) > 15)) || { echo "too few files to lift"; exit 1; }
# Headers of C++ have neither folder nor extension.
if grep -rn '^ *# *include *<' runtime | grep -vE '<(glm/[a-z_/]+\.hpp|[a-z_]+)>'; then
    echo "the lines above include something besides GLM and the standard library"
    exit 1
fi
find runtime -name '*.h' -printf '#include "%p"\n' >headers.cpp
while read -r line; do # each by itself
    "$cxx" -std=c++20 -fsyntax-only -I . -x c++ - <<<"$line"
done <headers.cpp
"$cxx" -std=c++20 -O1 -I . headers.cpp runtime/ltc/*.cpp runtime/map/*.cpp "$source/samples/shade_point.cpp" -o shade_point
./shade_point | tee printed
awk -f "$source/tests/samples/check_shade_point.awk" printed
