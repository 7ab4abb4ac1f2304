#!/bin/sh
# Runs all tests, and says at the end which took longest and how much of the budget is used.
set -eu

cargo=${CARGO:-cargo}
# Seconds that the tests should take on two cores, without building them.
budget=900

log=$(mktemp)
trap 'rm -f "$log" "$log.status"' EXIT

$cargo test --no-run
started=$(date +%s)
# The times of single tests are a feature of the harness that is only switched on for nightly compilers, or by this variable: it is
# given to the tests that run, not to the compiler.
{
    $cargo --config "target.'cfg(all())'.runner = ['env', 'RUSTC_BOOTSTRAP=1']" \
        test --lib --bins --tests -- -Zunstable-options --report-time && status=0 || status=$?
    echo "$status" >"$log.status"
} 2>&1 | tee "$log"
$cargo test --doc
took=$(($(date +%s) - started))

echo
echo "the ten slowest tests:"
sed -n 's/^test \(.*\) \.\.\. ok <\([0-9.]*\)s>$/\2 \1/p' "$log" | sort -rn | head -10 | sed 's/^/  /; s/ / s  /3'
echo "all tests: $took s; the budget is $budget s"
exit "$(cat "$log.status")"
