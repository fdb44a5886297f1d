#!/bin/bash
# Runs an ensemble in N parts, as many at a time as there are cores:
#
#   gnu_parallel.sh N FOLDER OPTIONS
#   examples/cluster/gnu_parallel.sh 8 parts --layers 22 --all
#
# A second run repeats only the failed parts. To use other machines that share the folder, set
# PARALLEL='--sshlogin HOST1,HOST2 --workdir .' (see `man parallel`).
set -euo pipefail

parts=$1 folder=$2
shift 2
mkdir -p "$folder"
# Each part takes one core.
export RAYON_NUM_THREADS=1
seq "$parts" | parallel --quote --joblog "$folder/jobs.log" --resume-failed \
    "${CANNONPILE:-cannonpile}" ensemble "$@" --shard "{}/$parts" --output "$folder/part-{}.json"
