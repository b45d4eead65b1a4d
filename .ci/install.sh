#!/usr/bin/env bash
# Installs whatever Debian package is missing to build and test Surimi. As root, or with sudo.
set -euo pipefail

packages=(g++ cmake ninja-build
    libembree-dev libopenmesh-dev libopenexr-dev libopenimageio-dev openimageio-tools libglm-dev libtinygltf-dev
    nlohmann-json3-dev libtbb-dev libcli11-dev libtomlplusplus-dev libfmt-dev libdraco-dev libmeshoptimizer-dev libhwy-dev libeigen3-dev libnanoflann-dev
    zlib1g-dev help2man
    libimgui-dev libglfw3-dev libgl-dev) # the last three for preview --window; without them the program is built without it
if [[ ${1:-} == --tests ]]; then
    packages+=(libgtest-dev libbenchmark-dev clang-format clang dpkg-dev file chromium xvfb xauth xdotool libgl1-mesa-dri)
    # gltf-validator runs on Node.js, of any source.
    command -v node >/dev/null && command -v npm >/dev/null || packages+=(nodejs npm)
fi

missing=()
for package in "${packages[@]}"; do
    [[ $(dpkg-query -W -f '${Status}' "$package" 2>/dev/null) == "install ok installed" ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

as_root=()
if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null || { echo "run as root, or install sudo, to install: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
fi
echo "installing ${#missing[@]} Debian packages: ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
