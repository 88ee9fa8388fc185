#!/usr/bin/env bash
# A million estimates, ten thousand registrations: does the process keep growing? Takes some
# minutes, and for nightly runs.
#
#   scripts/soak.sh [THOUSANDS_OF_ESTIMATES] [REGISTRATIONS]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
cmake --preset core --log-level=NOTICE
cmake --build --preset core --parallel "$(nproc)" --target pcl_flashreg_soak
exec build/core/test/pcl_flashreg_soak "$@"
