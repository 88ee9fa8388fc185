#!/usr/bin/env bash
# Formats the C++ and CUDA sources that git tracks.
#
#   scripts/format.sh            in place
#   scripts/format.sh --check    changes nothing, fails if something would change
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
case "${1-}" in
  "") options=(-i) ;;
  --check) options=(--dry-run --Werror) ;;
  *)
    echo "usage: $0 [--check]" >&2
    exit 2
    ;;
esac
if ! command -v clang-format >/dev/null; then
  echo "$0: needs clang-format (Debian and Ubuntu: apt-get install clang-format)" >&2
  exit 1
fi
git ls-files -z -- '*.h' '*.hpp' '*.cpp' '*.cu' '*.cuh' |
  xargs --null --no-run-if-empty clang-format "${options[@]}"
