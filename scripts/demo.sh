#!/usr/bin/env bash
# Installs what is missing, builds pcl_flashreg_align, aligns the two scan pairs in data/
# with no initial guess, and compares the poses with the true ones.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
scripts/install_dependencies.sh
cmake --preset release --log-level=WARNING
cmake --build --preset release --parallel "$(nproc)" --target pcl_flashreg_align
align=$(find build/release -name pcl_flashreg_align -type f -perm -u+x)

results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT

# Error of the first pose file against the second: "<degrees> <metres>".
pose_error() {
  awk '
    { for (column = 1; column <= 4; ++column)
        pose[FILENAME, FNR, column] = $column }
    END {
      for (i = 1; i <= 3; ++i) {
        difference = pose[ARGV[1], i, 4] - pose[ARGV[2], i, 4]
        squared_distance += difference * difference
        for (j = 1; j <= 3; ++j)
          for (k = 1; k <= 3; ++k)   # R_found * transpose(R_true)
            R[i, j] += pose[ARGV[1], i, k] * pose[ARGV[2], j, k]
      }
      x = R[3, 2] - R[2, 3]; y = R[1, 3] - R[3, 1]; z = R[2, 1] - R[1, 2]
      angle = atan2(sqrt(x * x + y * y + z * z), R[1, 1] + R[2, 2] + R[3, 3] - 1)
      printf "%.3f %.3f\n", angle * 57.29577951308232, sqrt(squared_distance)
    }' "$1" "$2"
}

# A time from the report: milliseconds <report> <name>
milliseconds() {
  sed -n "s/.*\"$2\": *\([0-9.]*\).*/\1/p" "$1" | head -n 1 | xargs printf '%.1f'
}

# align_pair <folder> <leaf, metres> <largest error, degrees> <largest error, metres>
align_pair() {
  local pair=data/$1 pose=$results/$1.txt report=$results/$1.json trusted=0
  "$align" "$pair/source.pcd" "$pair/target.pcd" --leaf "$2" \
    --transform "$pose" --write-untrusted --json "$report" --quiet || trusted=$?
  if ((trusted > 1)) || [[ ! -f $pose ]]; then
    echo "$0: no pose for $pair: pcl_flashreg_align ended with $trusted" >&2
    return 1
  fi
  local degrees metres
  read -r degrees metres < <(pose_error "$pose" "$pair/T_target_source.txt")

  echo
  echo "$pair: T_target_source ($( ((trusted == 0)) && echo trusted || echo NOT trusted))"
  awk '{ printf "  %10.6f %10.6f %10.6f %12.6f\n", $1, $2, $3, $4 }' "$pose"
  echo "  error: $degrees degrees, $metres m"
  echo "  time: $(milliseconds "$report" total) ms from clouds to pose, of which" \
    "$(milliseconds "$report" estimation) ms from correspondences to pose"
  awk -v d="$degrees" -v m="$metres" -v max_d="$3" -v max_m="$4" \
    'BEGIN { exit !(d < max_d && m < max_m) }' && ((trusted == 0))
}

failed=0
align_pair indoor 0.05 5 0.1 || failed=1
align_pair street 0.3 2 0.3 || failed=1
if ((failed)); then
  echo "$0: a pose is wrong, or right and not trusted" >&2
fi
exit "$failed"
