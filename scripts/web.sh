#!/bin/sh
# Builds the page: static files in target/page (or $1), for any static host.
#
# WEB_PROFILE=page-check builds it in the least time, several times as large: to see whether it works, not to be served.
set -eu

cargo=${CARGO:-cargo}
target=${CARGO_TARGET_DIR:-target}
out=${1:-$target/page}
profile=${WEB_PROFILE:-web}
# Most bytes of the program, and of what a host sends of it when it compresses by gzip. By brotli it is a quarter less.
most=8000000
most_sent=3000000

need() {
    echo "make web needs $1: $2" >&2
    exit 2
}
rustup target add wasm32-unknown-unknown >/dev/null 2>&1 || need "the target wasm32-unknown-unknown" "rustup target add wasm32-unknown-unknown"

# Every browser that has WebGPU has SIMD; without it what draws glyphs brings a substitute along that is 1.4 MB larger.
RUSTFLAGS="-C target-feature=+simd128" $cargo rustc --quiet --package cutaway-viewer --lib --crate-type cdylib --profile "$profile" --target wasm32-unknown-unknown
mkdir -p "$out"
# The other package leaves dependencies as the tests have them.
$cargo build --quiet --package cutaway-bindgen --package workspace-hack
"$target/debug/cutaway-bindgen" "$target/wasm32-unknown-unknown/$profile/cutaway_viewer.wasm" "$out"
program=$out/cutaway_viewer_bg.wasm
cp crates/viewer/web/index.html crates/viewer/web/judge.js "$out"
cp docs/images/crank.png "$out/still.png"

bytes=$(wc -c <"$program")
sent=$(gzip -9 -c "$program" | wc -c)
echo "$out: $bytes bytes of program, $sent compressed"
[ "$profile" != web ] || { [ "$bytes" -le "$most" ] && [ "$sent" -le "$most_sent" ]; } || {
    echo "it is larger than $most bytes, or than $most_sent compressed" >&2
    exit 1
}
