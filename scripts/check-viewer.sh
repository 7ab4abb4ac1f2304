#!/bin/sh
# Opens a real window on a virtual display, drags in it with a mouse, takes its device away, and looks at what is on the screen.
#
#   scripts/check-viewer.sh [PROGRAM]      # target/release/cutaway-viewer where none is named
#
# Wants Xvfb, xdotool and ImageMagick (Debian: xvfb xdotool imagemagick). Screens stay in target/check-viewer. That the check can fail is
# shown by itself: a program that says it is ready and draws nothing must not pass.
set -eu

target=${CARGO_TARGET_DIR:-target}
program=${1:-$target/release/cutaway-viewer}
out=$target/check-viewer
mkdir -p "$out"
export XDG_RUNTIME_DIR="${XDG_RUNTIME_DIR:-/tmp}"
# Whenever this file is there, the program destroys its device. Scenes that it keeps stay here as well.
export CUTAWAY_LOSE_DEVICE="$out/lose-device"
export XDG_STATE_HOME="$(cd "$out" && pwd)/state"
rm -f "$CUTAWAY_LOSE_DEVICE"

for tool in Xvfb xdotool import compare convert; do
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

# Whether the picture between the panels is the same on two screens.
same_picture() {
    for screen in "$1" "$2"; do
        convert "$out/$screen.png" -crop 640x600+260+60 +repage "$out/$screen-picture.png"
    done
    found=$(apart "$1-picture" "$2-picture")
    echo "$3: $found px"
    [ "$found" -le 200 ]
}

# A screen that has not changed for three seconds: edges are smooth by then, however busy the machine is.
still() {
    shot "$1"
    for _ in $(seq 40); do
        sleep 3
        shot later
        found=$(apart "$1" later)
        mv "$out/later.png" "$out/$1.png"
        [ "$found" -eq 0 ] && return 0
    done
    return 1
}

# Waits until the program has said so many times that it is ready.
ready() {
    for _ in $(seq 300); do
        [ "$(grep -c '^ready' "$out/log")" -ge "$1" ] && return 0
        kill -0 "$viewer" 2>/dev/null || return 1
        sleep 0.1
    done
    return 1
}

# Takes the device away from the program that was looked at: its window is there again with the scene, and ends when that happens again at
# once.
lose() {
    xdotool key s
    still before || return 1
    : >"$CUTAWAY_LOSE_DEVICE"
    ready 2 || return 1
    still reopened || return 1
    same_picture before reopened "a lost device leaves the scene" || return 1
    expect empty reopened "which is drawn again" 200000 || return 1
    # Ten seconds after it was opened again it may be lost again.
    sleep 8
    : >"$CUTAWAY_LOSE_DEVICE"
    ready 3 || return 1
    : >"$CUTAWAY_LOSE_DEVICE"
    code=0
    wait "$viewer" || code=$?
    viewer=
    echo "two losses at once: exit code $code"
    [ "$code" -eq 2 ] && grep -q 'lost twice' "$out/log"
}

if ! look "$program" view shape:crank --section -z=50%; then
    echo "error: the window does not follow; its screens are in $out" >&2
    exit 1
fi
if ! lose; then
    echo "error: the window does not outlive its device; its screens are in $out" >&2
    exit 1
fi
sleep 0.5

without_adapter() {
    code=0
    VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent "$program" view shape:cube >"$out/log" 2>&1 || code=$?
    [ "$code" -eq 2 ] && grep -q 'mesa-vulkan-drivers' "$out/log"
}
if ! without_adapter; then
    echo "error: without an adapter it is not told what to install; see $out/log" >&2
    exit 1
fi
echo "without an adapter it is told what to install"

if look sh -c 'echo ready; sleep 60'; then
    echo "error: a program that draws nothing passed" >&2
    exit 1
fi
echo "a program that draws nothing does not pass"
