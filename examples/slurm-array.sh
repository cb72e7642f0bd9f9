#!/bin/sh
# slurm-array.sh: a catalogue as a job array on Slurm: sbatch examples/slurm-array.sh MODELS PICTURES
#
# Each task draws its part of the models (docs/batch.md, "Many machines"). A task whose node fails is requeued, and goes on where its
# journal ends. Single tasks again: sbatch --array=17,23 examples/slurm-array.sh MODELS PICTURES. MODELS and PICTURES lie on a file
# system that all nodes share. The number of shards stands in two places: --array=0-(N-1) and shards=N.
#
# `make test-long` runs this script on a Slurm of three nodes.
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

# exec: lambent is the process that Slurm signals before the time is over, and it ends within a second. --failures-ok: models that cannot be
# drawn are in the journal, and do not mark the task as failed (sacct). `lambent journal PICTURES` summarises all tasks.
exec lambent batch "$models" -o "$pictures/{dir}/{stem}.png" -s 256 \
    --shard "auto/$shards" --resume --retry-failed 1 --failures-ok -j "${SLURM_CPUS_PER_TASK:-1}"
