#!/bin/sh
# Draws the pictures of the documents by the commands of their pages, with the program that is given: `scripts/gallery.sh target/release/cutaway`.
set -eu
program=$1
for page in docs/gallery/index.md docs/images/README.md; do
    grep '^cutaway ' "$page" | while IFS= read -r line; do
        echo "$line"
        # What the page says is what is run, quotes and all.
        eval "\"\$program\" ${line#cutaway } --quiet"
    done
done
# What is in the repository stays small.
for folder in docs/gallery:6000000 docs/images:4500000; do
    bytes=$(du -sb "${folder%:*}" | cut -f1)
    echo "${folder%:*} holds $bytes bytes"
    [ "$bytes" -lt "${folder#*:}" ]
done
