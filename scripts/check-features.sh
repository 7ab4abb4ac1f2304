#!/bin/sh
# Checks the library by parts: what a host embeds, with files, with what judges, and for a browser; and how many crates come along.
set -eu

cargo=${CARGO:-cargo}
# Crates beneath the library without features, itself left out.
most=90

for features in "" io lab; do
    echo "library with features: ${features:-none}"
    $cargo clippy --quiet --lib --no-default-features --features "$features" -- -D warnings
done

# Items that the documentation of the library without features lists.
most_items=250
RUSTDOCFLAGS="-D warnings" $cargo doc --quiet --lib --no-deps --no-default-features
items=$(grep -o '<li>' "${CARGO_TARGET_DIR:-target}/doc/cutaway/all.html" | wc -l)
echo "library without features: $items public items, at most $most_items"
[ "$items" -le "$most_items" ]

count=$($cargo tree --edges normal --no-default-features --prefix none | sed 's/ (.*//' | sort -u | wc -l)
count=$((count - 1))
echo "library without features: $count crates beneath it, at most $most"
[ "$count" -le "$most" ]

if rustup target add wasm32-unknown-unknown 2>/dev/null; then
    echo "library for a browser, without features and with io"
    for features in "" io; do
        $cargo check --quiet --lib --no-default-features --features "$features" --target wasm32-unknown-unknown
    done
    echo "the viewer for a browser"
    $cargo clippy --quiet --lib --package cutaway-viewer --target wasm32-unknown-unknown -- -D warnings
else
    echo "NOT CHECKED: whether the library compiles for a browser (rustup has no target wasm32-unknown-unknown here)" >&2
fi
