#!/bin/sh
# Makes a dataset on a Slurm cluster: an array of shards, then the merge. While frames are missing after a merge, and
# the last round brought some, array and merge are submitted again.
#
#   tools/dataset/slurm.sh CONFIG.yaml FOLDER SHARDS [OPTIONS OF SBATCH...]
#   tools/dataset/slurm.sh scenes/hri.yaml /shared/hri 64 --cpus-per-task=16 --time=8:00:00
#
# FOLDER is seen by all nodes. PLUVIA names the program (default: build/pluvia). Ahead of a time limit Slurm sends
# SIGUSR1: the frame in hand is dropped, and the next round makes it.
set -eu

submit() {
    mkdir -p "$DATASET_FOLDER/logs"
    # shellcheck disable=SC2086  # options are words
    array=$(DATASET_STAGE=shard sbatch --parsable --export=ALL --array="1-$DATASET_SHARDS" --signal=B:USR1@60 \
        --output="$DATASET_FOLDER/logs/slurm_%A_%a.txt" $DATASET_OPTIONS "$DATASET_SCRIPT")
    # shellcheck disable=SC2086
    merge=$(DATASET_STAGE=merge sbatch --parsable --export=ALL --dependency="afterany:$array" \
        --output="$DATASET_FOLDER/logs/slurm_%j_merge.txt" $DATASET_OPTIONS "$DATASET_SCRIPT")
    echo "array $array of $DATASET_SHARDS shards, merge $merge"
}

case "${DATASET_STAGE:-submit}" in
submit)
    [ $# -ge 3 ] || { sed -n '2,10s/^# \{0,1\}//p' "$0" >&2; exit 2; }
    DATASET_CONFIG=$(realpath "$1") DATASET_FOLDER=$(realpath -m "$2") DATASET_SHARDS=$3
    shift 3
    DATASET_OPTIONS=$* DATASET_SCRIPT=$(realpath "$0") PLUVIA=$(realpath "${PLUVIA:-build/pluvia}") DATASET_MISSING=
    export DATASET_CONFIG DATASET_FOLDER DATASET_SHARDS DATASET_OPTIONS DATASET_SCRIPT DATASET_MISSING PLUVIA
    submit
    ;;
shard)
    "$PLUVIA" dataset run "$DATASET_CONFIG" -o "$DATASET_FOLDER" --shard "$SLURM_ARRAY_TASK_ID/$DATASET_SHARDS" \
        --threads "${SLURM_CPUS_PER_TASK:-1}" --progress none &
    run=$!
    # Slurm tells this shell and not its child; a wait that a signal ends is taken up again.
    trap 'kill -USR1 "$run" 2>/dev/null || true' USR1 TERM
    code=0
    wait "$run" || code=$?
    while kill -0 "$run" 2>/dev/null; do
        code=0
        wait "$run" || code=$?
    done
    exit "$code"
    ;;
merge)
    code=0
    "$PLUVIA" dataset merge "$DATASET_CONFIG" -o "$DATASET_FOLDER" || code=$?
    [ "$code" -eq 5 ] || exit "$code"
    missing=$(wc -l <"$DATASET_FOLDER/failed.jsonl")
    if [ "$missing" = "$DATASET_MISSING" ]; then
        echo "the last round brought nothing: $missing frames are missing" >&2
        exit 5
    fi
    export DATASET_MISSING="$missing"
    submit
    ;;
esac
