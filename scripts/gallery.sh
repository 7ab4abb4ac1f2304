#!/bin/sh
# Draws the pictures of docs/gallery by the commands of its page, with the program that is given: `scripts/gallery.sh target/release/cutaway`.
set -eu
program=$1
page=docs/gallery/README.md
grep '^cutaway ' "$page" | while IFS= read -r line; do
    echo "$line"
    # What the page says is what is run, quotes and all.
    eval "\"\$program\" ${line#cutaway } --quiet"
done
bytes=$(du -sb docs/gallery | cut -f1)
echo "docs/gallery holds $bytes bytes"
# What is in the repository stays small.
[ "$bytes" -lt 6000000 ]
