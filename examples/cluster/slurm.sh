#!/bin/bash
# One part of an ensemble for each task of a job array. N parts of what the options say, into a folder that all nodes see:
#
#   sbatch --array=1-N slurm.sh N FOLDER OPTIONS
#   sbatch --array=1-8 examples/cluster/slurm.sh 8 parts --layers 22 --all
#
# When all are done: cannonpile merge parts/part-*.json --output whole.json
# A part that is missing, here the third, is run again alone:
#
#   sbatch --array=3 examples/cluster/slurm.sh 8 parts --layers 22 --all
#
#SBATCH --job-name=ensemble
#SBATCH --cpus-per-task=1
set -euo pipefail

# The size of the array is no number of parts: one that is run again is alone in its own.
parts=$1 folder=$2
shift 2
mkdir -p "$folder"
export RAYON_NUM_THREADS="${SLURM_CPUS_PER_TASK:-1}"
exec "${CANNONPILE:-cannonpile}" ensemble "$@" --shard "$SLURM_ARRAY_TASK_ID/$parts" \
    --output "$folder/part-$SLURM_ARRAY_TASK_ID.json"
