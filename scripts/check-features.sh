#!/bin/sh
# Checks what a host embeds by itself: without features, with its files, and for a browser; how many crates come along, and how many items
# its documentation lists.
set -eu

cargo=${CARGO:-cargo}
# Crates beneath the core without features, itself left out.
most=75
# Items that the documentation of the core lists.
most_items=250

# `cutaway-io` is made of the core without features. `workspace-hack` leaves dependencies as they are compiled for the whole
# workspace.
for packages in "cutaway cutaway-io" cutaway-lab; do
    echo "$packages: without features that others want"
    $cargo clippy --quiet --lib $(printf -- '--package %s ' $packages workspace-hack) -- -D warnings
done

RUSTDOCFLAGS="-D warnings" $cargo doc --quiet --lib --no-deps --package cutaway
items=$(grep -o '<li>' "${CARGO_TARGET_DIR:-target}/doc/cutaway/all.html" | wc -l)
echo "cutaway: $items public items, at most $most_items"
[ "$items" -le "$most_items" ]

count=$($cargo tree --package cutaway --edges normal --prefix none | sed 's/ (.*//' | sort -u | wc -l)
count=$((count - 1))
echo "cutaway: $count crates beneath it, at most $most"
[ "$count" -le "$most" ]

if rustup target add wasm32-unknown-unknown 2>/dev/null; then
    echo "for a browser: cutaway, cutaway-io and the viewer"
    $cargo clippy --quiet --lib --package cutaway-viewer --package workspace-hack --target wasm32-unknown-unknown -- -D warnings
    $cargo check --quiet --lib --package cutaway --package cutaway-io --package workspace-hack --target wasm32-unknown-unknown
else
    echo "NOT CHECKED: whether the library compiles for a browser (rustup has no target wasm32-unknown-unknown here)" >&2
fi
