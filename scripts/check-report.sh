#!/bin/sh
# Opens a report in a real headless browser and checks what no test of its text can: that nothing is fetched, that the script runs
# without an error, that tables sort, that the slider moves the divider, that charts have marks, and that nothing overflows the width of
# a phone (390 px), a laptop (1280 px) or a desk (1400 px), in light and in dark. Leaves screenshots to look at.
#
#   scripts/check-report.sh REPORT.html [FOLDER FOR SCREENSHOTS]
#
# Needs Chromium and Node 20.10 or later. Not part of `make test`, for a machine that builds need not have a browser.
# --plant adds faults to a copy of the report, each of which must be found: the proof that the checks can fail.
set -eu

plant=
if [ "${1:-}" = --plant ]; then
    plant=--plant
    shift
fi
[ $# -ge 1 ] || { sed -n '2,10s/^# \{0,1\}//p' "$0" >&2; exit 2; }
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
[ -n "$browser" ] || { echo "no Chromium found: install it, for example with: apt-get install -y chromium" >&2; exit 2; }
[ -f "$1" ] || { echo "$1: there is no such file" >&2; exit 2; }

exec node --experimental-websocket "$(dirname "$0")/check-report.mjs" "$browser" "$1" "${2:-$(dirname "$1")/screenshots}" $plant
