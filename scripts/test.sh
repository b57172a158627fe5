#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs, builds with warnings as errors and runs every test; those with threads also under ThreadSanitizer.
set -euo pipefail
# shellcheck source=scripts/lib.sh
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

usage() {
  cat <<USAGE
usage: $program [--sanitize]

Installs what is missing, builds with warnings as errors and runs all tests; then those with several
threads once more under ThreadSanitizer.

  --sanitize  also run the tests under the address and undefined-behaviour sanitizers
  --help      this text

Tests on real sequences want the folder that holds them in ORBSLAM_DATA; without it they are skipped.
Exit codes: 0 all passed, 1 a test or the build failed, 2 wrong usage.
USAGE
}

# Tells which tests, or cases of one, were skipped, and why: GoogleTest's word for it, and our scripts'.
print_skipped() {  # BUILD_DIR
  awk '
    / Testing: / { test = $NF }
    is_next { print "  " test ": " $0; is_next = 0 }
    /: Skipped$/ { is_next = 1 }
    /^skipped: / { sub(/^skipped: /, ""); print "  " test ": " $0 }
  ' "$1/Testing/Temporary/LastTest.log" | sort -u | sed '1i skipped, because:'
}

summary=()
failed=false
launcher=()  # what ctest is started by
run_tests() {  # TITLE PRESET CTEST_OPTION...
  local title=$1 dir=$root/build/$2
  shift 2
  echo "$title: testing"
  "${launcher[@]}" ctest --test-dir "$dir" -j "$(nproc)" --output-on-failure --no-tests=error "$@" 2>&1 | tee "$dir/ctest.log" ||
    failed=true
  print_skipped "$dir"
  summary+=("$title: $(grep -E 'tests passed|No tests' "$dir/ctest.log" | tail -n 1 ||
    echo "ctest broke off; see $dir/ctest.log")")
}

# Without address randomisation where that is allowed: ThreadSanitizer of gcc 12 cannot place its memory on
# kernels that randomise many bits.
run_threads_under_tsan() {
  ! setarch "$(uname -m)" -R true 2>/dev/null || launcher=(setarch "$(uname -m)" -R)
  export TSAN_OPTIONS="halt_on_error=1 suppressions=$root/tests/tsan_suppressions.txt"
  echo "ThreadSanitizer: building"
  build tsan tests_threads
  run_tests ThreadSanitizer tsan -L threads
  launcher=()
}

run_under_asan() {
  export ASAN_OPTIONS="detect_leaks=1" UBSAN_OPTIONS="print_stacktrace=1"
  export LSAN_OPTIONS="suppressions=$root/tests/lsan_suppressions.txt:print_suppressions=0"
  echo "AddressSanitizer: building"
  build asan
  run_tests AddressSanitizer asan -L 'unit|property|threads|e2e|determinism' -LE dataset
}

sanitize=false
while (($#)); do
  case $1 in
    --help | -h) usage; exit 0 ;;
    --sanitize) sanitize=true ;;
    *) fail 2 "$1: unknown; see $program --help" ;;
  esac
  shift
done

echo "installing dependencies"
install_dependencies
echo "release: building"
build release
run_tests release release
run_threads_under_tsan
if $sanitize; then run_under_asan; fi

printf '\n'
printf '%s\n' "${summary[@]}"
! $failed || fail 1 "some tests failed (total $((SECONDS / 60)) min $((SECONDS % 60)) s)"
echo "$program: all tests passed (total $((SECONDS / 60)) min $((SECONDS % 60)) s)"
