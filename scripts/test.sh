#!/bin/sh
# Runs all tests, and says at the end which took longest, how much of the budget is used, and how many had no real meshes to look at.
set -eu

cargo=${CARGO:-cargo}
# Seconds that the tests should take on two cores, without building them. It fails nothing: machines differ.
budget=600

log=$(mktemp)
trap 'rm -f "$log" "$log.status" "$log.not_checked"' EXIT
# Where tests without real meshes write their names (tests/it/common/data.rs).
export CUTAWAY_NOT_CHECKED="$log.not_checked"

# Tests that draw wait for one of a few sessions, and frames leave cores idle.
export RUST_TEST_THREADS="${RUST_TEST_THREADS:-$((2 * $(getconf _NPROCESSORS_ONLN)))}"

$cargo test --workspace --no-run
started=$(date +%s)
# The times of single tests are a feature of the harness that is only switched on for nightly compilers, or by this variable: it is
# given to the tests that run, not to the compiler.
{
    $cargo --config "target.'cfg(all())'.runner = ['env', 'RUSTC_BOOTSTRAP=1']" \
        test --workspace --no-fail-fast --lib --bins --tests -- -Zunstable-options --report-time && status=0 || status=$?
    echo "$status" >"$log.status"
} 2>&1 | tee "$log"
$cargo test --workspace --doc
took=$(($(date +%s) - started))

echo
echo "the ten slowest tests:"
sed -n 's/^test \(.*\) \.\.\. ok <\([0-9.]*\)s>$/\2 \1/p' "$log" | sort -rn | head -10 | sed 's/^/  /; s/ / s  /3'
echo "all tests: $took s; the budget is $budget s"
if [ -z "${CUTAWAY_LONG:-}" ] && [ "$took" -gt "$budget" ]; then
    echo "OVER BUDGET by $((took - budget)) s: if this machine is no slower than two cores, shorten the slowest tests"
fi
if [ -s "$CUTAWAY_NOT_CHECKED" ]; then
    echo
    echo "NOT CHECKED: $(sort -u "$CUTAWAY_NOT_CHECKED" | wc -l) tests had no real meshes to look at, for there is no such folder:"
    cut -d ' ' -f 2- "$CUTAWAY_NOT_CHECKED" | sort -u | sed 's/^/  /'
    echo "  \$CUTAWAY_DATA may name another; the tests passed without a look"
fi
exit "$(cat "$log.status")"
