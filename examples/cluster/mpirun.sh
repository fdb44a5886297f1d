#!/bin/bash
# Runs one part of an ensemble on each rank. The files are written into a shared folder:
#
#   mpirun -n N mpirun.sh FOLDER OPTIONS
#   mpirun -n 8 examples/cluster/mpirun.sh parts --layers 22 --all
#
# The ranks do not communicate; mpirun only starts them. This works with Open MPI and with MPICH and its derivatives.
set -euo pipefail

folder=$1
shift
rank=${OMPI_COMM_WORLD_RANK:-${PMI_RANK:?start this script with mpirun}}
parts=${OMPI_COMM_WORLD_SIZE:-${PMI_SIZE:?start this script with mpirun}}
mkdir -p "$folder"
# Each part takes one core.
export RAYON_NUM_THREADS=1
exec "${CANNONPILE:-cannonpile}" ensemble "$@" --shard "$((rank + 1))/$parts" --output "$folder/part-$((rank + 1)).json"
