#!/bin/sh
# Builds the book into target/book and checks every link of it, without the network. The first time it installs mdBook, which takes some minutes.
set -eu

cargo=${CARGO:-cargo}
target=${CARGO_TARGET_DIR:-target}
# The tool is of one version, so that what is built does not depend on the day.
version=0.5.4
tools=$target/docs-tools
if [ "$("$tools/bin/mdbook" --version 2>/dev/null)" != "mdbook v$version" ]; then
    # Without the server that reloads pages.
    $cargo install --quiet --locked --root "$tools" --version "$version" --no-default-features --features search mdbook
fi

case $target in /*) out=$target/book ;; *) out=$PWD/$target/book ;; esac
rm -rf "$out"
"$tools/bin/mdbook" build docs --dest-dir "$out"
# What is no page of the book.
rm -f "$out/book.toml"
# That the check can fail, and then what it finds.
python3 scripts/check_links.py --plant >/dev/null
python3 scripts/check_links.py "$out"
