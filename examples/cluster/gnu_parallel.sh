#!/bin/bash
# N parts of an ensemble, as many at a time as there are cores:
#
#   gnu_parallel.sh N FOLDER OPTIONS
#   examples/cluster/gnu_parallel.sh 8 parts --layers 22 --all
#
# Run again it does what has failed, and nothing else. On other machines too, with a folder that all of them see:
# PARALLEL='--sshlogin HOST1,HOST2 --workdir .' (`man parallel`).
set -euo pipefail

parts=$1 folder=$2
shift 2
mkdir -p "$folder"
# Each part takes one core.
export RAYON_NUM_THREADS=1
seq "$parts" | parallel --quote --joblog "$folder/jobs.log" --resume-failed \
    "${CANNONPILE:-cannonpile}" ensemble "$@" --shard "{}/$parts" --output "$folder/part-{}.json"
