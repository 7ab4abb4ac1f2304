"""Outside baselines: the same cuts by this project and by others, on the same machine in the same run. See README.md.

Ends with 1 where areas disagree beyond their bound.
"""

import argparse
import shlex
import sys
from pathlib import Path

import planar
import record
import relief
from ours import Cutaway


def options():
    parser = argparse.ArgumentParser(prog="run.sh", description=__doc__)
    parser.add_argument("--cutaway", required=True, type=Path, help="the command, built with --release")
    parser.add_argument("--out", required=True, type=Path, help="folder of the run: records go to its folder `peers`")
    parser.add_argument("--data", type=Path, help="folder of real meshes; without it only made ones are cut")
    parser.add_argument("--quick", action="store_true", help="fewer meshes, pixels and rounds")
    parser.add_argument("--only", choices=["planar", "relief"], help="one of the two records")
    parser.add_argument("--plant", action="store_true", help="peers cut elsewhere: the checks must fail")
    given = parser.parse_args()
    if not given.cutaway.is_file():
        parser.error(f"--cutaway {given.cutaway}: there is no such file; build it by `cargo build --release`")
    if given.data and not given.data.is_dir():
        parser.error(f"--data {given.data}: there is no such folder; leave it out to cut made meshes alone")
    given.rounds, given.pixels = (3, 512) if given.quick else (7, 1024)
    return given


def main():
    given = options()
    folder = given.out / "peers"
    work = folder / "work"
    work.mkdir(parents=True, exist_ok=True)
    cutaway = Cutaway(given.cutaway)
    about = {"version": cutaway.version(), "commit": record.commit_of_sources()}
    command = shlex.join(["experiments/peers/run.sh", *sys.argv[1:]])
    missed = 0
    for what, module in {"planar": planar, "relief": relief}.items():
        if given.only in (None, what):
            rows, checks = module.run(cutaway, work, given)
            record.write(folder / f"{what}.json", what, about, command, rows, checks)
            missed += told(what, rows, checks)
    print(f"records: {folder}")
    return 1 if missed else 0


def told(what, rows, checks):
    """Prints a summary; the number of checks that failed."""
    for r in rows:
        if r["reason"]:
            print(f"{what}: {r['mesh']}, {r['cut']}: {r['tool']} {r['outcome']}: {r['reason']}")
    missed = [c for c in checks if not c["holds"]]
    for c in missed:
        print(
            f"DISAGREES: {c['mesh']}, {c['cut']}: {c['tool']} has {c['area']:.9g}, not {c['truth']:.9g}: "
            f"off by {c['off']:.3g}, allowed are {c['bound']:.3g} ({c['bound_is']})"
        )
    print(f"{what}: {len(rows)} rows, {len(checks)} areas compared, {len(missed)} disagree")
    return len(missed)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except record.Refused as refusal:
        # Of peers these are findings; of ours, there is nothing to compare with.
        print(f"error: cutaway does not do it: {refusal}", file=sys.stderr)
        sys.exit(2)
