#!/usr/bin/env bash
# Evaluates the public pairs and pairs without overlap, and fits the confidence to the rows.
#
#   scripts/fit_confidence.sh DATA [FOLDER]
#
# DATA holds the scans and pairs.tsv; FOLDER (default: build/confidence) gets the rows.
# pcl_flashreg_evaluate must be on the PATH. Needs python3-numpy and python3-matplotlib.
set -euo pipefail

data=${1:?folder of the data sets}
out=${2:-build/confidence}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
mkdir -p "$out"

python3 "$here/pairs_without_overlap.py" "$data/pairs.tsv" --dataset 3DMatch 3DLoMatch \
  --overlaps "$data/3dmatch/benchmarks/3DMatch" > "$out/none.tsv"
python3 "$here/pairs_without_overlap.py" "$data/pairs.tsv" \
  --dataset KITTI_10m_corr KITTI_raw BALM --separate turboreg_kitti_demo \
  > "$out/none_outdoors.tsv"

# evaluate NAME LIST LEAF MAX_ROTATION MAX_TRANSLATION [DATASET ...]
evaluate() {
  local name=$1 list=$2 leaf=$3 rotation=$4 translation=$5
  shift 5
  rm -f "$out/$name.csv" "$out/$name.times.csv"
  pcl_flashreg_evaluate "$list" --root "$data" "${@/#/--dataset=}" --leaf "$leaf" \
    --max-rotation "$rotation" --max-translation "$translation" \
    --method flashreg_fast,flashreg,flashreg_source_viewpoint,flashreg_no_viewpoint --csv "$out/$name.csv"
}

evaluate indoor "$data/pairs.tsv" 0.05 15 0.3 3DMatch 3DLoMatch 3DMatch_raw
evaluate none "$out/none.tsv" 0.05 15 0.3
evaluate kitti "$data/pairs.tsv" 0.3 5 0.6 KITTI_10m_corr KITTI_raw
evaluate none_outdoors "$out/none_outdoors.tsv" 0.3 5 0.6
evaluate balm "$data/pairs.tsv" 0.25 5 0.6 BALM
evaluate bunny "$data/pairs.tsv" 0.0025 10 0.02 stanford_bunny
evaluate nclt "$data/pairs.tsv" 0.3 5 0.6 NCLT
evaluate lidar "$data/pairs.tsv" 0.1 5 0.3 Hilti14_basement Indoor16line_rotating
evaluate table "$data/pairs.tsv" 0.006 5 0.03 UR5_D435_tabletop
evaluate icl "$data/pairs.tsv" 0.025 5 0.15 ICL_NUIM
evaluate kinect "$data/pairs.tsv" 0.04 5 0.2 slambook_kinect
evaluate others "$data/pairs.tsv" 0.1 5 0.3 pcl_tutorials fast_gicp

python3 "$here/fit_confidence.py" \
  "$out"/{indoor,none,kitti,none_outdoors,balm,bunny,nclt,lidar,table,icl,kinect,others}.csv \
  --plot "$out/verdict.svg"
