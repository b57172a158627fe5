#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes orbslam.bin again: fetches the picture packages of Debian 12 (not installed, only unpacked), and trains on them.
# Usage: train.sh TRAIN_VOCABULARY OUT [WORK_FOLDER]
#   TRAIN_VOCABULARY  the program built from Examples/Vocabulary
#   OUT               vocabulary to write
#   WORK_FOLDER       keeps packages and pictures there (about 5 GB); without it, a temporary folder removed at the end
# Needs apt-get, dpkg-deb, python3 (to unzip) and the network.
set -euo pipefail

# Packages to train on, see README.md; versions are those of the shipped file.
readonly packages=(
  mate-backgrounds             # 1.26.0-1
  plasma-workspace-wallpapers  # 4:5.27.5-2
  ukui-wallpapers              # 20.04.3-1.1
  torcs-data                   # 1.3.7+dfsg-5
  ufoai-textures               # 2.5-2
)

fetch() {  # fetch PACKAGE: unpacks it into packages/PACKAGE
  local package=$1
  [[ -d "$work/packages/$package" ]] && return
  rm -rf "$work/download" && mkdir -p "$work/download"
  (cd "$work/download" && apt-get -qq download "$package")
  dpkg-deb -x "$work/download"/*.deb "$work/download/unpacked"
  find "$work/download/unpacked" -name '*.pk3' -exec python3 -m zipfile -e {} {}.unpacked \;
  mkdir -p "$work/packages"
  mv "$work/download/unpacked" "$work/packages/$package"
}

# What is no picture of anything, and the same wallpaper in another size.
readonly no_picture='/(gui|icons|karts|models|skins)/|screenshot|preview|normal|_nm?\.|_gloss|_local\.'
readonly small_copy='/(440x247|640x480|720x1440|800x600|1024x768|1080x1920|1280x[0-9]+|1440x900|1600x1200)\.'
readonly other_copy='/(1622x2880|1638x1024|1680x1050|1920x1080|1920x1200|2560x1440)\.|Elephants_'

collect() {  # collect PACKAGE: links its pictures into pictures/PACKAGE
  local package=$1 file name
  rm -rf "$work/pictures/$package" && mkdir -p "$work/pictures/$package"
  while IFS= read -r file; do
    name=${file#"$work/packages/$package/"}
    ln -s "$file" "$work/pictures/$package/${name//\//_}"
  done < <(find "$work/packages/$package" -type f -size +30k | grep -iE '\.(jpe?g|png)$' |
             grep -ivE "$no_picture|$small_copy|$other_copy")
}

if [[ $# -lt 2 || $# -gt 3 ]]; then
  sed -n '3,9s/^# //p' "$0" >&2
  exit 2
fi
readonly program=$1 out=$2
if [[ $# -eq 3 ]]; then
  mkdir -p "$3"
  work=$(cd "$3" && pwd)
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi

folders=()
for package in "${packages[@]}"; do
  echo "package $package"
  fetch "$package"
  collect "$package"
  folders+=("$work/pictures/$package")
done
"$program" --out "$out" -k 10 -L 5 --seed 1 --features 1000 "${folders[@]}"
