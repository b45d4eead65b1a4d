#!/usr/bin/env bash
# The package as a user meets it: shade_point.sh SOURCE BUILD CMAKE. Installs, moves what was installed elsewhere, builds
# samples/ against it outside the tree, and checks what the sample prints.
set -euo pipefail
source=$1 build=$2 cmake=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --prefix "$work/first" >"$work/log" || { tail "$work/log"; exit 1; }
mv "$work/first" "$work/moved"
"$work/moved/bin/surimi" --version

# Neither the build nor the machine: every library by the name of its package, none by its path.
package=$(dirname "$(find "$work/moved" -name surimi-config.cmake)")
for file in surimi-config surimi-config-version surimi-targets libraries; do
    [[ -s $package/$file.cmake ]] || { echo "no $file.cmake is installed"; exit 1; }
done
if grep -rnE "$source|$build|$work|LINK_LIBRARIES.*[\";:]/" "$package"; then
    echo "the lines above tie the package to a place"
    exit 1
fi
if grep -nE -- "-Werror|-Wall|-ffp-contract|surimi_options" "$package"/surimi-targets*.cmake; then
    echo "the lines above force our flags on others"
    exit 1
fi

build() { # build FOLDER: out of tree, against the package
    "$cmake" -S "$1" -B "$1/build" -DCMAKE_PREFIX_PATH="$work/moved" -DCMAKE_BUILD_TYPE=Release >"$work/log" 2>&1 &&
        "$cmake" --build "$1/build" >"$work/log" 2>&1 || { tail -n 20 "$work/log"; exit 1; }
}

mkdir "$work/samples"
cp "$source"/samples/CMakeLists.txt "$source"/samples/*.cpp "$work/samples"
build "$work/samples"
"$work/samples/build/shade_point" | tee "$work/printed"
awk -f "$source/tests/samples/check_shade_point.awk" "$work/printed"

# Every installed header compiles together with the others, with warnings on, and all of the library links.
mkdir "$work/all"
(cd "$work/moved/include/surimi" && find . -name '*.h' -printf '#include "%P"\n') >"$work/all/all.cpp"
(($(wc -l <"$work/all/all.cpp") > 20)) || { echo "too few headers are installed"; exit 1; }
echo 'int main() {}' >>"$work/all/all.cpp"
cat >"$work/all/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(everything LANGUAGES CXX)
find_package(surimi 0.1 REQUIRED)
add_executable(everything all.cpp)
target_compile_options(everything PRIVATE -Wall -Wextra -Werror)
target_link_libraries(everything PRIVATE $<LINK_LIBRARY:WHOLE_ARCHIVE,surimi::runtime>)
END
build "$work/all"
