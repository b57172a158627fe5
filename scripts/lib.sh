# SPDX-License-Identifier: GPL-3.0-or-later
# What demo.sh and test.sh share. Sourced, by bash with `set -euo pipefail`.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
readonly root program=${0##*/}

# Clones in different folders share what ccache keeps.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1

fail() {  # CODE MESSAGE
  echo "$program: error: $2" >&2
  exit "$1"
}

# Runs a command whose output only matters if it fails: then its end is shown, and one line says what failed.
quietly() {  # WHAT LOG_FILE COMMAND...
  local what=$1 log=$2
  shift 2
  mkdir -p "${log%/*}" 2>/dev/null || fail 2 "${log%/*}: cannot be made; check the permissions"
  "$@" >"$log" 2>&1 || {
    tail -n 25 "$log" >&2
    fail 1 "$what failed; all of its output is in $log"
  }
}

install_dependencies() {
  quietly "installing the dependencies" "$root/build/install_deps.log" "$root/scripts/install_deps.sh"
}

# Configures a preset of CMakePresets.json and builds the targets, or everything, in build/PRESET.
build() {  # PRESET [TARGET...]
  local preset=$1 targets=()
  shift
  if (($#)); then targets=(--target "$@"); fi
  quietly "configuring the preset $preset" "$root/build/$preset/configure.log" cmake -S "$root" --preset "$preset"
  quietly "building the preset $preset" "$root/build/$preset/build.log" \
    cmake --build "$root/build/$preset" -j "$(nproc)" "${targets[@]}"
}
