#!/bin/bash
# Runs one part of an ensemble in each task of a job array. The N files are written into a shared folder:
#
#   sbatch --array=1-N slurm.sh N FOLDER OPTIONS
#   sbatch --array=1-8 examples/cluster/slurm.sh 8 parts --layers 22 --all
#
# When all tasks are done: cannonpile merge parts/part-*.json --output whole.json
# To run a missing part again, here the third:
#
#   sbatch --array=3 examples/cluster/slurm.sh 8 parts --layers 22 --all
#
#SBATCH --job-name=ensemble
#SBATCH --cpus-per-task=1
set -euo pipefail

# N is an argument, because an array that repeats one part has only one task.
parts=$1 folder=$2
shift 2
mkdir -p "$folder"
export RAYON_NUM_THREADS="${SLURM_CPUS_PER_TASK:-1}"
exec "${CANNONPILE:-cannonpile}" ensemble "$@" --shard "$SLURM_ARRAY_TASK_ID/$parts" \
    --output "$folder/part-$SLURM_ARRAY_TASK_ID.json"
