#!/usr/bin/env bash
# Builds the core and its tests for a processor that stores numbers the other way round
# (s390x), and runs those that have to do with bits, files and arithmetic under QEMU. Takes
# some minutes; for nights and after changes of a format.
#
# Debian and Ubuntu: apt-get install g++-s390x-linux-gnu qemu-user libgtest-dev libeigen3-dev
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=build/big_endian
tests=(test_scan test_kernels test_surface_kernels test_stages test_feature_matching
  test_resolution test_alignment test_parameters)
toolchain=(-DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=s390x
  -DCMAKE_CXX_COMPILER=s390x-linux-gnu-g++ -DCMAKE_C_COMPILER=s390x-linux-gnu-gcc
  -DCMAKE_BUILD_TYPE=Release)

for program in s390x-linux-gnu-g++ qemu-s390x; do
  if ! command -v "$program" >/dev/null; then
    echo "$0: needs $program (see its first lines)" >&2
    exit 1
  fi
done
if [[ ! -f $build/prefix/lib/libgtest.a ]]; then
  cmake -S /usr/src/googletest -B $build/googletest --log-level=NOTICE "${toolchain[@]}" \
    -DBUILD_GMOCK=OFF -DCMAKE_INSTALL_PREFIX="$PWD/$build/prefix"
  cmake --build $build/googletest --parallel "$(nproc)"
  cmake --install $build/googletest >/dev/null
fi
cmake -S . -B $build/core --log-level=NOTICE "${toolchain[@]}" \
  -DPCL_FLASHREG_WITH_PCL=OFF -DPCL_FLASHREG_WITH_CUDA=OFF -DPCL_FLASHREG_BUILD_TESTS=ON \
  -DCMAKE_PREFIX_PATH="$PWD/$build/prefix" -DEigen3_DIR=/usr/share/eigen3/cmake \
  -DCMAKE_EXE_LINKER_FLAGS=-static -DCMAKE_CROSSCOMPILING_EMULATOR=qemu-s390x
cmake --build $build/core --parallel "$(nproc)" --target "${tests[@]}"
for test in "${tests[@]}"; do
  qemu-s390x "$build/core/test/$test" --gtest_brief=1
done
