#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs, builds, tracks a sequence and evaluates the result.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

readonly results=$root/results/demo
readonly vocabulary=$root/Vocabulary/orbslam.bin
readonly bin=$root/build/release/Examples

usage() {
  cat <<USAGE
usage: $program [SEQUENCE_DIR [SETTINGS]]

Installs what is missing, builds, tracks a sequence, prints its errors and draws its trajectory.
All results go to $results.

  SEQUENCE_DIR  a sequence in the layout of the TUM RGB-D benchmark, such as scripts/fetch_tum.sh
                downloads; without it a synthetic one is made
  SETTINGS      camera settings; default: SEQUENCE_DIR/camera.yaml, else the file in config/ of the
                freiburg1, freiburg2 or freiburg3 in the folder's name
  --help        this text

Exit codes: 0 done, 1 installing, building or evaluating failed, 2 bad input, 130 interrupted.
USAGE
}

choose_settings() {  # SEQUENCE_DIR -> path
  local name
  name=$(basename "$1")
  if [[ -f $1/camera.yaml ]]; then
    echo "$1/camera.yaml"
  elif [[ $name =~ (freiburg|fr)([123])(_|$) ]]; then
    echo "settings: config/TUM${BASH_REMATCH[2]}.yaml, by the folder's name" >&2
    echo "$root/config/TUM${BASH_REMATCH[2]}.yaml"
  else
    fail 2 "$1: which camera? Pass its settings: $program $1 config/TUM1.yaml"
  fi
}

make_default_sequence() {
  sequence=$results/sequence
  echo "making a synthetic sequence"
  quietly "making the sequence" "$results/make_sequence.log" \
    "$bin/Synthetic/make_sequence" --out "$sequence" --motion xyz --frames 240 --quiet
}

track() {
  local arguments=(- "$settings" "$sequence") code=0
  [[ ! -f $vocabulary ]] || arguments[0]=$vocabulary
  [[ ! -f $sequence/associations.txt ]] || arguments+=("$sequence/associations.txt")
  echo "tracking $sequence"
  "$bin/RGB-D/rgbd_tum" "${arguments[@]}" --output-dir "$results" || code=$?
  ((code != 130)) || fail 130 "interrupted; what was computed until then is in $results"
  ((code <= 128)) || fail 1 "rgbd_tum crashed (exit code $code)"
  ((code == 0)) || exit "$code"  # it has said why
}

# The lines NAME.FIGURE VALUE UNIT of an evaluation as a row of the table.
table_row() {  # TITLE NAME FILE
  awk -v title="$1" -v name="$2" '
    { split($1, key, "."); if (key[1] == name) value[key[2]] = $2 }
    END { printf "  %-26s %8.4f %8.4f %8.4f %8.4f\n", title, value["rmse"], value["mean"], value["median"],
          value["max"] }' "$3"
}

evaluate() {
  local truth=$sequence/groundtruth.txt estimate=$results/CameraTrajectory.txt
  if [[ ! -f $truth ]]; then
    echo "$sequence: no groundtruth.txt in it, so there is nothing to compare with"
    return
  fi
  quietly "evaluating the absolute error" "$results/ate.txt" \
    "$root/scripts/evaluate_ate.py" "$truth" "$estimate" --verbose --plot "$results/trajectory.png"
  quietly "evaluating the drift" "$results/rpe.txt" \
    "$root/scripts/evaluate_rpe.py" "$truth" "$estimate" --verbose --fixed_delta --delta 1 --delta_unit s
  printf '\n  %-26s %8s %8s %8s %8s\n' "error against ground truth" RMSE mean median max
  table_row "ATE [m]" absolute_translational_error "$results/ate.txt"
  table_row "RPE, translation [m/s]" translational_error "$results/rpe.txt"
  table_row "RPE, rotation [deg/s]" rotational_error "$results/rpe.txt"
  printf '\nplot:       %s\n' "$results/trajectory.png"
}

[[ ${1:-} != --help && ${1:-} != -h ]] || { usage; exit 0; }
[[ $# -le 2 && ${1:-} != -* ]] || fail 2 "at most a sequence and its settings; see $program --help"
sequence=${1:-} settings=${2:-}
if [[ -n $sequence ]]; then
  [[ -d $sequence ]] || fail 2 "$sequence: no such folder; it should hold a sequence (see $program --help)"
  sequence=$(realpath "$sequence")
  [[ -n $settings ]] || settings=$(choose_settings "$sequence")
  [[ -f $settings ]] || fail 2 "$settings: no such settings file"
  [[ $sequence/ != "$results"/* ]] || fail 2 "$sequence: is among the results, which this run replaces"
  settings=$(realpath "$settings")
fi

echo "installing dependencies"
install_dependencies
echo "building (some minutes, the first time)"
build release rgbd_tum make_sequence
rm -rf "$results"
mkdir -p "$results"
[[ -n $sequence ]] || make_default_sequence
[[ -n $settings ]] || settings=$sequence/camera.yaml
track
evaluate
echo "results:    $results"
