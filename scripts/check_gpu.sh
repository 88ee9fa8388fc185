#!/usr/bin/env bash
# Checks the CUDA backend on this machine's GPU: builds the core alone, compares every stage
# with the CPU's on the device, looks for bad accesses, races and wrong barriers, and times
# it where the benchmark is built. Writes OUT/check_gpu.json.
#
#   scripts/check_gpu.sh [OUT]      OUT is a folder, ./check_gpu by default
#
#   PCL_FLASHREG_EIGEN          folder that holds Eigen/Core      [/usr/include/eigen3]
#   PCL_FLASHREG_GOOGLETEST     sources of GoogleTest             [/usr/src/googletest]
#   PCL_FLASHREG_ARCHITECTURES  for CMAKE_CUDA_ARCHITECTURES      [this device's]
#   PCL_FLASHREG_CMAKE_ARGS     more arguments for CMake, e.g. -DPCL_FLASHREG_BUILD_BENCHMARKS=ON
#   PCL_FLASHREG_DATASETS       folder with real data sets
#
# Needs a compiler, CMake, CUDA with compute-sanitizer, and those two sources. Fails if any
# check does, and with 77 where there is no device.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=${1:-check_gpu}
eigen=${PCL_FLASHREG_EIGEN:-/usr/include/eigen3}
googletest=${PCL_FLASHREG_GOOGLETEST:-/usr/src/googletest}
read -ra cmake_args <<<"${PCL_FLASHREG_CMAKE_ARGS:-}"
mkdir -p "$out"
out=$(cd "$out" && pwd)
build=$out/build
PATH=$PATH:/usr/local/cuda/bin

require() {
  if [[ ! -e $1 ]]; then
    echo "$0: no $1; set $2" >&2
    exit 2
  fi
}
require "$eigen/Eigen/Core" PCL_FLASHREG_EIGEN
require "$googletest/CMakeLists.txt" PCL_FLASHREG_GOOGLETEST

# query NAME: what the driver says of the first device, or nothing.
query() {
  nvidia-smi --query-gpu="$1" --format=csv,noheader 2>/dev/null | head -n 1 || true
}
device=$(query name)
driver=$(query driver_version)
capability=$(query compute_cap)
architectures=${PCL_FLASHREG_ARCHITECTURES:-${capability/./}}

# Headers are all there is to Eigen: this much of a package finds them.
mkdir -p "$build/eigen"
cat >"$build/eigen/Eigen3Config.cmake" <<CMAKE
if(NOT TARGET Eigen3::Eigen)
  add_library(Eigen3::Eigen INTERFACE IMPORTED)
  set_target_properties(Eigen3::Eigen PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "$eigen")
endif()
CMAKE
printf 'set(PACKAGE_VERSION 3.4.0)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n' \
  >"$build/eigen/Eigen3ConfigVersion.cmake"

cmake -S "$googletest" -B "$build/googletest" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_INSTALL_PREFIX="$build/prefix" >/dev/null
cmake --build "$build/googletest" --parallel --target install >/dev/null

cmake -S "$root" -B "$build/core" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$build/prefix" -DEigen3_DIR="$build/eigen" \
  -DPCL_FLASHREG_WITH_PCL=OFF -DPCL_FLASHREG_BUILD_TESTS=ON -DPCL_FLASHREG_WITH_CUDA=ON \
  ${architectures:+-DPCL_FLASHREG_CUDA_ARCHITECTURES="$architectures"} \
  -DPCL_FLASHREG_WERROR=ON "${cmake_args[@]}"
targets=(test_cuda_conformance)
if [[ ${cmake_args[*]} == *BUILD_BENCHMARKS=ON* ]]; then
  targets+=(pcl_flashreg_benchmark)
fi
cmake --build "$build/core" --parallel --target "${targets[@]}"

if [[ -z $device ]]; then
  echo "$0: built, but there is no device to check it on" >&2
  exit 77
fi
commit=$(git -C "$root" describe --always --dirty 2>/dev/null || echo unknown)

# check NAME COMMAND...: runs it, its output in OUT/NAME.log, and notes how it ended.
failed=0
results=()
check() {
  local name=$1 outcome=passed
  shift
  # A test that found no device skips itself, which is not what we are here for.
  if ! "$@" >"$out/$name.log" 2>&1 || grep -q "^backend cuda:" "$out/$name.log"; then
    outcome=failed
    failed=1
    tail -n 30 "$out/$name.log" >&2
  elif grep -q "SKIPPED" "$out/$name.log"; then
    outcome="passed, with tests skipped"
  fi
  echo "$name: $outcome"
  results+=("    \"$name\": \"$outcome\"")
}

check conformance "$build/core/test/test_cuda_conformance"
# The sanitizers slow kernels down by orders of magnitude: every kernel, on small problems.
small='CudaGuess.*:CudaScores.*:*n129_*:*ties_on_a_grid*:*rows_over_capacity*:*empty_graph*'
for tool in memcheck racecheck synccheck; do
  check "$tool" compute-sanitizer --tool "$tool" --error-exitcode 1 \
    "$build/core/test/test_cuda_conformance" --gtest_filter="$small"
done

benchmark=$build/core/apps/benchmark/pcl_flashreg_benchmark
figures=null
if [[ -x $benchmark ]]; then
  check benchmark "$benchmark" --backend cuda --json "$out/benchmark.json"
  [[ -s $out/benchmark.json ]] && figures=$(<"$out/benchmark.json")
fi

{
  echo "{"
  echo "  \"device\": \"$device\","
  echo "  \"driver\": \"$driver\","
  echo "  \"compute_capability\": \"$capability\","
  echo "  \"cuda\": \"$(nvcc --version | sed -n 's/.*, V//p')\","
  echo "  \"commit\": \"$commit\","
  echo "  \"checks\": {"
  (IFS=$'\n' && echo "${results[*]}" | sed '$!s/$/,/')
  echo "  },"
  echo "  \"benchmark\": $figures"
  echo "}"
} >"$out/check_gpu.json"
cat "$out/check_gpu.json"
exit "$failed"
