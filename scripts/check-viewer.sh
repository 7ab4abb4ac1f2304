#!/bin/sh
# Opens a real window on a virtual display, drags in it with a mouse, and looks at what is on the screen.
#
#   scripts/check-viewer.sh [PROGRAM]      # target/release/cutaway-viewer where none is named
#
# Wants Xvfb, xdotool and ImageMagick (Debian: xvfb xdotool imagemagick). Screens stay in target/check-viewer. That the check can fail is
# shown by itself: a program that says it is ready and draws nothing must not pass.
set -eu

program=${1:-target/release/cutaway-viewer}
out=${CARGO_TARGET_DIR:-target}/check-viewer
mkdir -p "$out"
export XDG_RUNTIME_DIR="${XDG_RUNTIME_DIR:-/tmp}"

for tool in Xvfb xdotool import compare; do
    if ! command -v "$tool" >/dev/null; then
        echo "error: there is no $tool" >&2
        echo "  help: install xvfb, xdotool and imagemagick" >&2
        exit 2
    fi
done

# A display of its own, whose number is asked for.
Xvfb -displayfd 3 -screen 0 1280x800x24 3>"$out/display" 2>"$out/xvfb.log" &
server=$!
viewer=
trap '[ -z "$viewer" ] || kill "$viewer" 2>/dev/null; kill "$server" 2>/dev/null' EXIT
for _ in $(seq 100); do
    [ -s "$out/display" ] && break
    sleep 0.1
done
export DISPLAY=":$(cat "$out/display")"

shot() {
    import -window root "$out/$1.png"
}

# How many pixels two screens differ in.
apart() {
    compare -metric AE -fuzz 2% "$out/$1.png" "$out/$2.png" null: 2>&1 | awk '{ printf "%d", $1 }'
}

expect() {
    found=$(apart "$1" "$2")
    echo "$3: $found px"
    [ "$found" -ge "$4" ]
}

# Runs a program and drags in its window; fails where the screen does not follow.
look() {
    shot empty
    "$@" >"$out/log" 2>&1 &
    viewer=$!
    for _ in $(seq 300); do
        grep -q '^ready' "$out/log" && break
        kill -0 "$viewer" || return 1
        sleep 0.1
    done
    grep -q '^ready' "$out/log" || return 1
    sleep 3
    shot open
    expect empty open "the window opens" 200000 || return 1
    xdotool mousemove 600 300 mousedown 1
    for x in 620 660 700 740; do
        xdotool mousemove "$x" 320
        sleep 0.1
    done
    xdotool mouseup 1
    # Where the pointer will be when the key is pressed, so that the key alone makes the difference.
    xdotool mousemove 600 300
    sleep 2
    shot turned
    expect open turned "a drag turns the model" 5000 || return 1
    # There is no window manager to give it the keyboard.
    xdotool search --name '^cutaway$' windowfocus
    xdotool key w
    sleep 2
    shot wiped
    expect turned wiped "a key shows both slots" 500 || return 1
}

if ! look "$program" view shape:crank --section -z=50%; then
    echo "error: the window does not follow; its screens are in $out" >&2
    exit 1
fi
kill "$viewer"
wait "$viewer" 2>/dev/null || true
viewer=
sleep 0.5

if look sh -c 'echo ready; sleep 60'; then
    echo "error: a program that draws nothing passed" >&2
    exit 1
fi
echo "a program that draws nothing does not pass"
