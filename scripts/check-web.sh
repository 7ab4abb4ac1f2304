#!/bin/sh
# Uses the page in a real browser without a window: a model is dropped, a cut moved by the mouse, methods are compared, a link is followed.
#
#   scripts/check-web.sh [PAGE] [PROGRAM]      # target/page as `make web` makes it, target/release/cutaway
#
# Pictures are compared with those of the command, pixel by pixel. Wants Chromium, Python 3 and ImageMagick (Debian: chromium python3
# imagemagick). What was seen stays in target/check-web. That the check can fail is shown by itself: the picture of another cut must differ.
set -eu

target=${CARGO_TARGET_DIR:-target}
page=${1:-$target/page}
program=${2:-$target/release/cutaway}

for tool in chromium python3 convert; do
    if ! command -v "$tool" >/dev/null; then
        echo "error: there is no $tool" >&2
        echo "  help: install chromium, python3 and imagemagick" >&2
        exit 2
    fi
done
for file in "$page/index.html" "$program"; do
    if ! [ -f "$file" ]; then
        echo "error: there is no $file" >&2
        echo "  help: run make web and cargo build --release" >&2
        exit 2
    fi
done
exec python3 scripts/check_web.py "$page" "$program" "$target/check-web"
