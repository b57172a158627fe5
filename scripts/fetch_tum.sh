#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Downloads and unpacks sequences of the TUM RGB-D benchmark (Sturm et al., IROS 2012; CC BY 4.0).
# Safe to run again: resumes what was interrupted, leaves alone what is complete.
set -euo pipefail

readonly program=${0##*/}
scripts_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly scripts_dir
readonly base_url=${ORBSLAM_TUM_URL:-https://cvg.cit.tum.de/rgbd/dataset}
output_dir=datasets
keep_archive=false
staging=""

usage() {
  cat <<USAGE
usage: $program [--output-dir DIR] [--keep-archive] NAME...

Downloads sequences of the TUM RGB-D benchmark, unpacks each to DIR/rgbd_dataset_freiburgN_... and
writes its associations.txt. An interrupted download is resumed by the same command.

  NAME              fr3_walking_xyz, freiburg3_walking_xyz or rgbd_dataset_freiburg3_walking_xyz
  --output-dir DIR  where the sequences go (default: datasets)
  --keep-archive    keep the .tgz after unpacking
  --help            this text

ORBSLAM_TUM_URL replaces the address (default: https://cvg.cit.tum.de/rgbd/dataset).
Exit codes: 0 all there, 1 a download or an archive failed, 2 wrong usage or unknown name.
USAGE
}

fail() {  # CODE MESSAGE
  echo "$program: error: $2" >&2
  exit "$1"
}

full_name() {  # NAME -> rgbd_dataset_freiburgN_..., or nothing
  sed -nE 's/^(rgbd_dataset_)?(freiburg|fr)([123]_[a-z0-9_]+)$/rgbd_dataset_freiburg\3/p' <<<"$1"
}

unreachable() {  # CURL_EXIT_CODE URL
  fail 1 "${2%/*}: the server cannot be reached; check the network and the proxy (curl error $1)"
}

explain_curl() {  # CURL_EXIT_CODE HTTP_CODE URL
  case $1 in
    5 | 6 | 7) unreachable "$1" "$3" ;;
    22) case $2 in
          404) fail 1 "$3: no such sequence on the server (HTTP 404); check the name" ;;
          *) fail 1 "$3: the server refuses (HTTP $2); try again later" ;;
        esac ;;
    23) fail 1 "$output_dir: cannot be written; check the free space and the permissions" ;;
    *) fail 1 "$3: the download broke off (curl error $1); run the same command again to resume" ;;
  esac
}

remote_size() {  # URL -> bytes, or nothing if the server does not say
  local answer code=0
  answer=$(curl -fsIL --connect-timeout 20 --max-time 60 -w '\nhttp_code: %{http_code}\n' "$1") || code=$?
  ((code == 0 || code == 22)) || unreachable $code "$1"
  ((code == 0)) || explain_curl $code "$(sed -n 's/^http_code: //p' <<<"$answer")" "$1"
  tr -d '\r' <<<"$answer" | sed -nE 's/^content-length: *([0-9]+)$/\1/Ip' | tail -n 1
}

file_size() {  # FILE -> bytes, 0 if there is none
  if [[ -e $1 ]]; then stat -c %s "$1"; else echo 0; fi
}

get() {  # URL FILE: appends what FILE lacks; prints the HTTP code, returns curl's
  local progress=--silent
  if [[ -t 2 ]]; then progress=--progress-bar; fi
  curl -fL -C - "$progress" --connect-timeout 20 --speed-limit 1000 --speed-time 60 \
    -w '%{http_code}' -o "$2" "$1"
}

download() {  # URL FILE: leaves FILE only when it is complete
  local url=$1 part=$2.part size have http code=0
  size=$(remote_size "$url")
  have=$(file_size "$part")
  if [[ -n $size ]] && ((have > size)); then rm -f "$part"; have=0; fi
  if [[ -z $size ]] || ((have < size)); then
    http=$(get "$url" "$part") || code=$?
    if ((code == 33)) || [[ $http == 416 ]]; then  # the server cannot resume
      code=0
      rm -f "$part"
      http=$(get "$url" "$part") || code=$?
    fi
    ((code == 0)) || explain_curl $code "$http" "$url"
  fi
  have=$(file_size "$part")
  [[ -z $size ]] || ((have == size)) ||
    fail 1 "$url: $have of $size bytes arrived; run the same command again to resume"
  mv "$part" "$2"
}

unpack() {  # ARCHIVE NAME: all or nothing
  local archive=$1 name=$2
  if ! gzip -t "$archive" 2>/dev/null || ! tar -tzf "$archive" >/dev/null 2>&1; then
    rm -f "$archive"
    fail 1 "$name.tgz: the archive is damaged and was removed; run the same command again"
  fi
  staging=$(mktemp -d "$output_dir/.unpack.XXXXXX")
  tar -xzf "$archive" -C "$staging" --no-same-owner 2>/dev/null ||
    fail 1 "$output_dir: cannot be unpacked to; check the free space and the permissions"
  if ! is_sequence "$staging/$name"; then
    rm -f "$archive"
    fail 1 "$name.tgz: holds no $name/rgb.txt and depth.txt and was removed; check ORBSLAM_TUM_URL"
  fi
  mv "$staging/$name" "$output_dir/$name"
  rm -rf "$staging"
}

is_sequence() { [[ -f $1/rgb.txt && -f $1/depth.txt ]]; }

fetch() {  # NAME, full
  local name=$1 target=$output_dir/$1 archive=$output_dir/$1.tgz
  if is_sequence "$target"; then
    echo "$target: already there"
  else
    [[ ! -e $target ]] || fail 1 "$target: exists but holds no sequence; move it away"
    local number=${name#rgbd_dataset_freiburg}
    echo "$target: downloading"
    [[ -f $archive ]] || download "$base_url/freiburg${number%%_*}/$name.tgz" "$archive"
    unpack "$archive" "$name"
    $keep_archive || rm -f "$archive"
  fi
  [[ -s $target/associations.txt ]] ||
    "$scripts_dir/associate.py" "$target/rgb.txt" "$target/depth.txt" --output "$target/associations.txt" ||
    fail 1 "$target: associations.txt could not be written"
  echo "$target: $(wc -l <"$target/associations.txt") frames"
}

names=()
while (($#)); do
  case $1 in
    --help | -h) usage; exit 0 ;;
    --output-dir) [[ -n ${2:-} ]] || fail 2 "--output-dir takes a folder"; output_dir=${2%/}; shift ;;
    --output-dir=?*) output_dir=${1#*=} ;;
    --keep-archive) keep_archive=true ;;
    -*) fail 2 "$1: unknown option; see $program --help" ;;
    *) full=$(full_name "$1")
       [[ -n $full ]] || fail 2 "$1: not the name of a sequence; write it like fr3_walking_xyz"
       names+=("$full") ;;
  esac
  shift
done
((${#names[@]})) || fail 2 "which sequence? e.g. $program fr3_walking_xyz; see $program --help"
command -v curl >/dev/null || fail 2 "curl is needed; install it (apt install curl)"
mkdir -p "$output_dir" 2>/dev/null || fail 2 "$output_dir: cannot be made; choose another --output-dir"
trap '[[ -z $staging ]] || rm -rf "$staging"' EXIT
for name in "${names[@]}"; do fetch "$name"; done
