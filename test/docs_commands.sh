#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
# Runs what the documentation tells people to run on the bundled scans, as it stands there.
#
#   test/docs_commands.sh SOURCES PROGRAMS
#
# A command ends with 0, or with what a comment behind it says: # exit 1
set -euo pipefail
sources=$1
PATH=$2:$PATH
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ln -s "$sources/data" "$folder/data"
cd "$folder"
run=0
while IFS= read -r line; do
  expected=0
  [[ $line =~ \#\ exit\ ([0-9]+) ]] && expected=${BASH_REMATCH[1]}
  read -ra command <<<"${line%%#*}"
  status=0
  "${command[@]}" >out 2>err || status=$?
  echo "$status: ${command[*]}"
  if ((status != expected)); then
    cat out err
    exit 1
  fi
  run=$((run + 1))
done < <(grep -h '^    pcl_flashreg_[a-z]* data/' "$sources"/docs/*.md)
((run >= 10)) || { echo "only $run commands found" >&2; exit 1; }
