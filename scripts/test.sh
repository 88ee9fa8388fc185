#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all the tests.
#
#   PCL_FLASHREG_DATASETS   folder with real data sets; tests that need one are skipped
#                           where it is absent
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/install_dependencies.sh --tests
# A compiler that is newer than this source may warn of something new: errors in CI alone.
# What was installed is for the system's Python, whichever comes first on the PATH.
cmake --preset ci --log-level=NOTICE -DPCL_FLASHREG_WERROR="${CI:+ON}" \
  -DPython3_EXECUTABLE=/usr/bin/python3
cmake --build --preset ci --parallel "$(nproc)"
ctest --preset ci --parallel "$(nproc)"
