#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs with and without the detector of moving objects and compares with bounds; see regression.sh --help.
set -euo pipefail
exec "$(dirname "${BASH_SOURCE[0]}")/regression.py" "$@"
