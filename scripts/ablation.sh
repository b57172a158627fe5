#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tells what each piece of evidence of the detector is worth; see ablation.sh --help.
set -euo pipefail
exec "$(dirname "${BASH_SOURCE[0]}")/ablation.py" "$@"
