#!/usr/bin/env bash
# Installs every package that building, testing and evaluating needs, from Debian 12's own archive.
# Safe to run again: installs only what is missing, and needs neither root nor network when nothing is.
set -euo pipefail

packages=(
  build-essential cmake ninja-build ccache pkg-config git  # build
  libopencv-dev libeigen3-dev libpcl-dev                   # images, linear algebra, point clouds
  libceres-dev libsuitesparse-dev                          # non-linear least squares
  libosmesa6-dev                                           # rendering without a display
  libspng-dev libturbojpeg0-dev                            # image decoding
  libcli11-dev libspdlog-dev libyaml-cpp-dev nlohmann-json3-dev  # command line, log, settings, reports
  libgtest-dev libgmock-dev libbenchmark-dev               # tests, benchmarks
  python3 python3-numpy python3-matplotlib python3-pil     # evaluation scripts
  python3-yaml                                             # bounds of scripts/regression.sh
  curl                                                     # scripts/fetch_tum.sh
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "install_deps: all ${#packages[@]} packages are installed"
  exit 0
fi

command -v apt-get >/dev/null || { echo "install_deps: needs Debian's apt-get; install by hand: ${missing[*]}" >&2; exit 2; }
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "install_deps: needs root or sudo to install: ${missing[*]}" >&2; exit 2; }
  as_root=(sudo)
fi
echo "install_deps: installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
