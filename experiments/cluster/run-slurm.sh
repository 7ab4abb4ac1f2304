#!/bin/bash
# Starts a Slurm of one node in a folder, runs an experiment and an animation as job arrays, kills a task of each and submits it again,
# and compares what comes out with the same without shares; then measures shares onto a disk that fills up. Ends with 0 where all are equal
# but for times.
# Needs root and Debian's packages slurm-wlm and munge, which it installs where apt-get can.
#   experiments/cluster/run-slurm.sh [PROGRAM]      the program is target/release/cutaway
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
program=$(realpath "${1:-$root/target/release/cutaway}")
[ -x "$program" ] || { echo "$program: there is no such program: cargo build --release" >&2; exit 2; }
[ "$(id -u)" -eq 0 ] || { echo "$0 starts daemons: run it as root" >&2; exit 2; }
for tool in slurmctld slurmd munged; do
    command -v $tool >/dev/null || { apt-get update -q && apt-get install -qy --no-install-recommends slurm-wlm munge; } >/dev/null
done
export CUTAWAY=$program XDG_RUNTIME_DIR=${XDG_RUNTIME_DIR:-/tmp}

work=$(mktemp -d /tmp/cutaway-slurm.XXXXXX)
cd "$work"
host=$(hostname -s)
# The program that is run, not Debian's script: it starts without a system manager.
mkdir -p munge state spool log
chmod 755 "$work"
chmod 700 munge
dd if=/dev/urandom of=munge/key bs=1024 count=1 status=none
chmod 400 munge/key
munged --force --key-file="$work/munge/key" --socket="$work/munge/socket" --pid-file="$work/munge/pid" \
    --log-file="$work/munge/log" --seed-file="$work/munge/seed"
cat >slurm.conf <<CONF
ClusterName=cutaway
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=17017
SlurmdPort=17018
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CryptoType=crypto/munge
CredType=cred/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
ReturnToService=2
SlurmUser=root
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmdSpoolDir=$work/spool
StateSaveLocation=$work/state
SlurmctldLogFile=$work/log/slurmctld.log
SlurmdLogFile=$work/log/slurmd.log
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobCompType=jobcomp/none
AccountingStorageType=accounting_storage/none
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
CONF
export SLURM_CONF=$work/slurm.conf
stop() {
    scancel --user root 2>/dev/null || true
    for pid in slurmd.pid slurmctld.pid munge/pid; do
        [ ! -s "$pid" ] || kill "$(cat $pid)" 2>/dev/null || true
    done
}
trap 'stop; umount "$work/small" 2>/dev/null || true; echo "what was done is in $work" >&2' EXIT
slurmctld -c
slurmd
for _ in $(seq 60); do
    [ "$(sinfo -h -o %T 2>/dev/null)" = idle ] && break
    sleep 1
done
sinfo

cat >cubes.toml <<'TOML'
question = "Are shares of an experiment the whole of it?"
analysis = "They have to be."
[[run]]
name = "crank"
resolution = [320, 240]
strategies = ["raycast+mask", "raycast+mask@compute", "grid:64+vds:256"]
rounds = 3
sweep.amplitude = { path = "cut.front.surfaces.0.amplitude", values = ["1%", "2%", "3%", "4%", "5%", "6%", "7%", "8%"] }
[run.scene]
part = [{ shape = "crank" }]
relief.ragged = { kind = "fractal" }
cut = [{ name = "front", surfaces = [{ section = "-z=50%", relief = "ragged" }] }]
TOML
scene=(shape:crank --section -z=50% --relief fractal --turntable --frames 24 --fps 12.5 --resolution 320,240)

# Waits until no job is left, or until a command is true.
until_idle() {
    for _ in $(seq 1200); do
        [ -n "$(squeue -h)" ] || return 0
        sleep 0.5
    done
    echo "jobs do not end:"; squeue; exit 1
}
kill_one() {
    # The task has to be at work, and not to have ended.
    for _ in $(seq 600); do
        if [ "$(squeue -h -r -j "$1_$2" -o %T 2>/dev/null)" = RUNNING ] && eval "$3"; then
            scancel --signal=KILL --full "$1_$2"
            echo "killed task $2 of job $1"
            return 0
        fi
        sleep 0.1
    done
    echo "task $2 of job $1 was never at work"; exit 1
}

job=$(sbatch --parsable --array=0-3 --cpus-per-task=1 "$here/measure.sbatch" cubes.toml many)
kill_one "$job" 1 '[ -s many/run.1-of-4.json ]'
until_idle
"$program" report many --complete -q && { echo "nothing is missing: the task was not killed at work"; exit 1; }
job=$(sbatch --parsable --array=1 --export=ALL,SHARES=4 --cpus-per-task=1 "$here/measure.sbatch" cubes.toml many)
until_idle
"$program" report many --complete

job=$(sbatch --parsable --array=0-3 --cpus-per-task=1 "$here/animate.sbatch" 'frames/%04d.png' "${scene[@]}")
kill_one "$job" 2 '[ -s frames/0014.png ]'
until_idle
"$program" encode 'frames/%04d.png' -o early.gif --fps 12.5 -q && { echo "no frame is missing: the task was not killed at work"; exit 1; }
job=$(sbatch --parsable --array=2 --export=ALL,SHARES=4 --cpus-per-task=1 "$here/animate.sbatch" 'frames/%04d.png' "${scene[@]}")
until_idle
"$program" encode 'frames/%04d.png' -o many.gif --fps 12.5

"$program" measure cubes.toml --out one -q
"$program" animate "${scene[@]}" -o one.gif -q
"$program" animate "${scene[@]}" -o 'whole/%04d.png' -q
python3 - <<'PY'
import json
from pathlib import Path

TIMES = {"sitting", "warnings", "time_ms", "samples", "took_s"}


def timeless(value, path=""):
    """What does not differ from one run to the next: no times, no loads, nothing that is worked out of them."""
    if isinstance(value, dict):
        return {k: timeless(v) for k, v in value.items() if k not in TIMES and "_ms" not in k and "times" not in k}
    return [timeless(v) for v in value] if isinstance(value, list) else value


errors = ("name", "outcome", "decided_wrong_px", "unmarked_wrong_px", "crack_px", "outline_px", "depth_error_max", "normal_error_deg_max")
one = sorted(p.name for p in Path("one/cubes").glob("crank.*.json"))
many = sorted(p.name for p in Path("many/cubes").glob("crank.*.json"))
assert one == many and len(one) == 8, (one, many)
tasks = set()
for name in one:
    a, b = (json.loads(Path(folder, "cubes", name).read_text()) for folder in ("one", "many"))
    for key in ("experiment", "run", "parameters", "is_quick", "identity", "scene", "makers", "pictures"):
        assert a[key] == b[key], (name, key)
    of = [[{k: s[k] for k in errors} for s in r["measurement"]["strategies"]] for r in (a, b)]
    assert of[0] == of[1] and len(of[0]) == 3, name
    tasks.add((b["sitting"]["job"], b["sitting"]["shard"]))
    assert b["sitting"]["node"] and b["sitting"]["adapter"]["name"], name
    for picture in a["pictures"]:
        files = [Path(folder, "cubes", picture["file"]).read_bytes() for folder in ("one", "many")]
        assert files[0] == files[1], (name, picture["file"])
assert {shard for _, shard in tasks} == {f"{i}/4" for i in range(4)}, tasks
for frame in range(1, 25):
    a, b = (Path(folder, f"{frame:04}.png").read_bytes() for folder in ("whole", "frames"))
    assert a == b, frame
assert Path("one.gif").read_bytes() == Path("many.gif").read_bytes(), "GIF"
print(f"equal: 8 points by {len(tasks)} tasks, 24 frames, one GIF of {Path('many.gif').stat().st_size} bytes")
PY

# A disk with room for about half of it: the shard that fills it up ends with an error, what is there stays whole, the report names what is
# missing, and with room the same commands go on.
mkdir small
half=$(($(du -sk one | cut -f1) / 2))
mount -t tmpfs -o "size=${half}k" tmpfs small
code=0
for share in 0 1; do
    "$program" measure cubes.toml --out small/run --shard $share/2 -q 2>>full.log || code=$?
done
[ "$code" -eq 2 ] || { echo "a full disk ended with exit code $code"; exit 1; }
grep -q 'help: ' full.log
[ -z "$(find small -name '.*.tmp')" ] || { echo "a file that is not whole was left behind"; exit 1; }
code=0
"$program" report small/run --out partial --complete -q 2>missing.log || code=$?
[ "$code" -eq 1 ] && grep -q 'missing: cubes/' missing.log || { echo "the report does not name what is missing"; exit 1; }
mount -o remount,size=64m small
for share in 0 1; do
    "$program" measure cubes.toml --out small/run --shard $share/2 -q
done
"$program" report small/run --out whole-report --complete -q
echo "a full disk: $(sed -n 's/^.*points; //p' missing.log | head -1); whole after there was room"
