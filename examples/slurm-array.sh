#!/bin/sh
# slurm-array.sh: draws a catalogue as a Slurm job array: sbatch examples/slurm-array.sh MODELS PICTURES
#
# Each task draws its part of the models (docs/batch.md, "Many machines"). A task whose node fails is requeued, and resumes where its
# journal ends. To repeat single tasks: sbatch --array=17,23 examples/slurm-array.sh MODELS PICTURES. MODELS and PICTURES must be on
# a file system that all nodes share. The number of shards occurs in two places: --array=0-(N-1) and shards=N.
#
# `make test-long` runs this script with Slurm on three nodes.
#SBATCH --job-name=lambent
#SBATCH --array=0-11
#SBATCH --cpus-per-task=4
#SBATCH --mem=4G
#SBATCH --time=02:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
set -eu
shards=${SHARDS:-12}
models=$1 pictures=$2

# With exec, Slurm signals lambent itself before the time is over, and lambent ends within a second. With --failures-ok, models that
# cannot be drawn are recorded in the journal, and do not mark the task as failed (sacct). `lambent journal PICTURES` summarises all
# tasks.
exec lambent batch "$models" -o "$pictures/{dir}/{stem}.png" -s 256 \
    --shard "auto/$shards" --resume --retry-failed 1 --failures-ok -j "${SLURM_CPUS_PER_TASK:-1}"
