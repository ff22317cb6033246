#!/bin/sh
# Run carried fuzz programs: sh run.sh EXECUTIONS CORES [PARSER]...
# Each program runs EXECUTIONS inputs, spread over CORES processes, and then the next. What is found is in found/.
# The log of each process is logs/PARSER-N. The seeds are 1 to CORES; seed=16 before the command begins with 17.
cd "$(dirname "$0")" || exit 1
executions=$1 cores=$2
[ "$cores" ] || { echo "usage: sh run.sh EXECUTIONS CORES [PARSER]..."; exit 2; }
shift 2
[ $# -gt 0 ] || set -- hairfile groomfile tfx tfx_text obj save members groom_arguments bench_arguments scene capture_arguments gltf
status=0
for parser; do
    case $parser in save | gltf) max=4096 ;; scene) max=2048 ;; groomfile) max=1536 ;; *_arguments) max=256 ;; *) max=1024 ;; esac
    start=$(date +%s) running=
    mkdir -p work/$parser logs found && rm -f logs/$parser-*
    for core in $(seq "$cores"); do
        ./$parser -seed=$((${seed:-0} + core)) -max_len=$max -runs=$((executions / cores)) -timeout=20 -rss_limit_mb=1024 \
            -print_final_stats=1 -verbosity=0 -artifact_prefix=found/$parser- work/$parser corpus/$parser \
            >logs/$parser-$core 2>&1 &
        running="$running $!"
    done
    failed=0
    for process in $running; do wait $process || failed=$((failed + 1)); done
    [ $failed = 0 ] || status=1
    cat logs/$parser-* | awk -v parser=$parser -v failed=$failed -v seconds=$(($(date +%s) - start)) '
        /number_of_executed_units/ { sum += $2 }
        END { printf "%-18s %d executions in %d s, %d processes failed\n", parser, sum, seconds, failed }'
done
exit $status
