#!/usr/bin/env bash
# Installs what the build needs and this machine lacks. Debian 12, Ubuntu 22.04 and 24.04.
#
#   scripts/install_dependencies.sh            for the library and the programs
#   scripts/install_dependencies.sh --tests    for the tests and benchmarks too
set -euo pipefail

needed=(cmake g++ make libeigen3-dev libpcl-dev libcairo2-dev libcli11-dev
  nlohmann-json3-dev)
# Without these some tests are skipped, and say so; not every release has them.
optional=()

case "${1-}" in
  "") ;;
  --tests)
    needed+=(libgtest-dev libbenchmark-dev)
    # Doxygen makes the documentation; matplotlib draws evaluations; pkg-config,
    # dpkg-shlibdeps and colcon are for the tests of the package. The Python module takes
    # pybind11, its tests the others of python3-*.
    optional=(doxygen help2man pybind11-dev python3-dev python3-numpy python3-pytest
      python3-open3d
      python3-matplotlib pkg-config dpkg-dev file
      colcon python3-colcon-cmake python3-colcon-ros
      python3-colcon-recursive-crawl python3-colcon-library-path
      python3-colcon-package-information python3-colcon-package-selection
      python3-colcon-output python3-colcon-parallel-executor)
    ;;
  *)
    echo "usage: $0 [--tests]" >&2
    exit 2
    ;;
esac

is_installed() {
  [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null) == installed* ]]
}

print_missing() {
  local package
  for package in "$@"; do
    is_installed "$package" || echo "$package"
  done
}

as_root() {
  if ((EUID == 0)); then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "$0: run it as root, or install sudo; it would run: $*" >&2
    exit 1
  fi
}

apt_get() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes \
    -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300 "$@"
}

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "$0: knows Debian and Ubuntu alone; elsewhere install what these packages hold:" \
    "${needed[*]} ${optional[*]}" >&2
  exit 1
fi

mapfile -t missing < <(print_missing "${needed[@]}")
mapfile -t missing_optional < <(print_missing "${optional[@]}")
if ((${#missing[@]} + ${#missing_optional[@]} == 0)); then
  exit 0
fi

# Offline, what is only optional stops nobody.
apt_get update || ((${#missing[@]} == 0))
for package in "${missing_optional[@]}"; do
  if apt-cache show "$package" >/dev/null 2>&1; then
    missing+=("$package")
  else
    echo "$0: this release has no $package: tests that need it will be skipped" >&2
  fi
done
if ((${#missing[@]} > 0)); then
  echo "$0: installing ${missing[*]}" >&2
  apt_get install --no-install-recommends "${missing[@]}"
fi
