#!/usr/bin/env bash
# Checks the CUDA backend on this machine's GPU: builds the core alone, compares every stage
# with the CPU's on the device, looks for bad accesses, races and wrong barriers, and times
# it. Writes OUT/check_gpu.json, and OUT/<step>.log of every step.
#
#   scripts/check_gpu.sh [OUT [STEP...]]      OUT is a folder, ./check_gpu by default
#
# Steps, all unless some are named: conformance ablation_conformance memcheck racecheck
# synccheck benchmark kitti ablation turboreg turboreg_kitti. A step whose data are not there
# is skipped.
#
#   PCL_FLASHREG_EIGEN          folder that holds Eigen/Core         [/usr/include/eigen3]
#   PCL_FLASHREG_GOOGLETEST     sources of GoogleTest                [/usr/src/googletest]
#   PCL_FLASHREG_CLI11          folder that holds CLI/CLI.hpp        [/usr/include]
#   PCL_FLASHREG_JSON           folder that holds nlohmann/json.hpp  [/usr/include]
#   PCL_FLASHREG_ARCHITECTURES  for CMAKE_CUDA_ARCHITECTURES         [this device's]
#   PCL_FLASHREG_CMAKE_ARGS     more arguments for CMake
#   PCL_FLASHREG_DATASETS       folder with real data sets           [../shared/data]
#   PCL_FLASHREG_TURBOREG       a checkout of TurboReg, to be timed where PyTorch is
#
# Needs a compiler, CMake, CUDA with compute-sanitizer and cuBLAS, and those sources. Fails
# if any check does, and with 77 where there is no device.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=${1:-check_gpu}
steps=" ${*:2} "
eigen=${PCL_FLASHREG_EIGEN:-/usr/include/eigen3}
googletest=${PCL_FLASHREG_GOOGLETEST:-/usr/src/googletest}
cli11=${PCL_FLASHREG_CLI11:-/usr/include}
json=${PCL_FLASHREG_JSON:-/usr/include}
datasets=${PCL_FLASHREG_DATASETS:-$root/../shared/data}
turboreg=${PCL_FLASHREG_TURBOREG:-}
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
require "$cli11/CLI/CLI.hpp" PCL_FLASHREG_CLI11
require "$json/nlohmann/json.hpp" PCL_FLASHREG_JSON

# query NAME: what the driver says of the first device, or nothing.
query() {
  nvidia-smi --query-gpu="$1" --format=csv,noheader 2>/dev/null | head -n 1 || true
}
device=$(query name)
driver=$(query driver_version)
capability=$(query compute_cap)
architectures=${PCL_FLASHREG_ARCHITECTURES:-${capability/./}}

# header_package NAME TARGET FOLDER VERSION: headers are all there is to these libraries;
# this much of a package finds them. Leaves the package's folder in $packages/NAME.
packages=$build/packages
header_package() {
  mkdir -p "$packages/$1"
  cat >"$packages/$1/$1Config.cmake" <<CMAKE
if(NOT TARGET $2)
  add_library($2 INTERFACE IMPORTED)
  set_target_properties($2 PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "$3")
endif()
CMAKE
  printf 'set(PACKAGE_VERSION %s)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n' "$4" \
    >"$packages/$1/$1ConfigVersion.cmake"
}
header_package Eigen3 Eigen3::Eigen "$eigen" 3.4.0
header_package CLI11 CLI11::CLI11 "$cli11" 2.1.0
header_package nlohmann_json nlohmann_json::nlohmann_json "$json" 3.11.0

cmake -S "$googletest" -B "$build/googletest" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_INSTALL_PREFIX="$build/prefix" >/dev/null
cmake --build "$build/googletest" --parallel --target install >/dev/null

cmake -S "$root" -B "$build/core" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$build/prefix" -DEigen3_DIR="$packages/Eigen3" \
  -DCLI11_DIR="$packages/CLI11" -Dnlohmann_json_DIR="$packages/nlohmann_json" \
  -DPCL_FLASHREG_WITH_PCL=OFF -DPCL_FLASHREG_BUILD_TESTS=ON \
  -DPCL_FLASHREG_BUILD_BENCHMARKS=ON -DPCL_FLASHREG_WITH_CUDA=ON \
  ${architectures:+-DPCL_FLASHREG_CUDA_ARCHITECTURES="$architectures"} \
  -DPCL_FLASHREG_WERROR=ON "${cmake_args[@]}"
cmake --build "$build/core" --parallel \
  --target test_cuda_conformance test_cuda_ablation pcl_flashreg_benchmark

if [[ -z $device ]]; then
  echo "$0: built, but there is no device to check it on" >&2
  exit 77
fi
commit=$(git -C "$root" describe --always --dirty 2>/dev/null || echo unknown)

# figures NAME: what a step wrote that ran just now, or null.
figures() {
  if [[ -s $out/$1.json && "${results[*]}" == *"\"$1\": "* ]]; then
    cat "$out/$1.json"
  else
    echo null
  fi
}
# report: writes check_gpu.json, after every step: a run that is cut off has not been in vain.
report() {
  {
    echo "{"
    echo "  \"device\": \"$device\","
    echo "  \"driver\": \"$driver\","
    echo "  \"compute_capability\": \"$capability\","
    echo "  \"cuda\": \"$(nvcc --version | sed -n 's/.*, V//p')\","
    echo "  \"commit\": \"$commit\","
    echo "  \"checks\": {"
    (IFS=$'\n' && echo "${results[*]}" | sed '$!s/$/,/')
    echo "  }"
    for step in benchmark kitti ablation turboreg turboreg_kitti; do
      echo "  ,\"$step\": $(figures "$step")"
    done
    echo "}"
  } >"$out/check_gpu.json"
}

# check NAME COMMAND...: runs a step, its output in OUT/NAME.log, and notes how it ended.
failed=0
results=()
check() {
  local name=$1 outcome=passed began=$SECONDS
  shift
  if [[ $steps != "  " && $steps != *" $name "* ]]; then
    return
  fi
  rm -f "$out/$name.json"
  # A test that found no device skips itself, which is not what we are here for.
  if ! "$@" >"$out/$name.log" 2>&1 || grep -q "^backend cuda:" "$out/$name.log"; then
    outcome=failed
    failed=1
    tail -n 30 "$out/$name.log" >&2
  elif grep -q "SKIPPED" "$out/$name.log"; then
    outcome="passed, with tests skipped"
  fi
  echo "$name: $outcome, $((SECONDS - began)) s"
  if [[ -s $out/$name.json ]]; then
    cat "$out/$name.log"
  fi
  results+=("    \"$name\": \"$outcome\"")
  report
}

export PCL_FLASHREG_DATASETS=$datasets
conformance=$build/core/test/test_cuda_conformance
check conformance "$conformance"
check ablation_conformance "$build/core/test/test_cuda_ablation"
# The sanitizers slow kernels down by orders of magnitude: every kernel, on small problems.
small='CudaGuess.*:CudaScores.*:*n129_*:*ties_on_a_grid*:*rows_over_capacity*:*empty_graph*'
for tool in memcheck racecheck synccheck; do
  check "$tool" compute-sanitizer --tool "$tool" --error-exitcode 1 \
    "$conformance" --gtest_filter="$small"
done

benchmark=$build/core/apps/benchmark/pcl_flashreg_benchmark
check benchmark "$benchmark" --backend cuda --json "$out/benchmark.json"
kitti=$datasets/turboreg_kitti_demo/000_fpfh_kpts
if [[ -e ${kitti}_src.txt ]]; then
  check kitti "$benchmark" --backend cuda --leaf 0.3 \
    --correspondences "${kitti}_src.txt,${kitti}_dst.txt" --json "$out/kitti.json"
fi
check ablation "$benchmark" --backend cuda --ablation --sizes 5000,7000 \
  --json "$out/ablation.json"
if [[ -n $turboreg ]]; then
  "$benchmark" --sizes 1000,2000,5000,7000,10000 --export "$out" >"$out/made.txt"
  mapfile -t made <"$out/made.txt"
  check turboreg python3 "$root/scripts/time_turboreg.py" --turboreg "$turboreg" \
    --leaf 0.05 --eigen "$eigen" --json "$out/turboreg.json" "${made[@]}"
  if [[ -e ${kitti}_src.txt ]]; then
    check turboreg_kitti python3 "$root/scripts/time_turboreg.py" --turboreg "$turboreg" \
      --leaf 0.3 --eigen "$eigen" --json "$out/turboreg_kitti.json" \
      "${kitti}_src.txt,${kitti}_dst.txt"
  fi
fi

echo "figures: $out/check_gpu.json"
exit "$failed"
