#!/bin/sh
# Whether `cutaway doctor` finds faults of a rasteriser: each is planted into the shaders of a copy of the tree, whose doctor must end with
# exit code 1; that of the tree as it is, with 0.
#
# Every fault costs a build of the library and 20 seconds, so this runs on demand. The profile is `dev`.
set -eu

cd "$(dirname "$0")/.."
cargo=${CARGO:-cargo}
export XDG_RUNTIME_DIR="${XDG_RUNTIME_DIR:-/tmp}"
mkdir -p "${CARGO_TARGET_DIR:-target}"
CARGO_TARGET_DIR=$(cd "${CARGO_TARGET_DIR:-target}" && pwd)/planted-faults
export CARGO_TARGET_DIR
copy=$CARGO_TARGET_DIR/tree
rm -rf "$copy"
mkdir -p "$copy"
git ls-files -z | tar --null --files-from - --create --file - | tar --extract --file - --directory "$copy"

failed=0

# A name, the exit code that is expected, a shader and what is replaced in it by what.
doctor() {
    name=$1 expected=$2 shader=$3 replaced=$4 by=$5
    if [ -n "$shader" ]; then
        grep -qF "$replaced" "$copy/shaders/$shader" || {
            echo "$name: $shader no longer holds: $replaced" >&2
            exit 2
        }
        sed -i "s|$replaced|$by|" "$copy/shaders/$shader"
    fi
    $cargo build --quiet --manifest-path "$copy/Cargo.toml"
    "$CARGO_TARGET_DIR/debug/cutaway" doctor >"$copy/doctor.txt" 2>&1 && code=0 || code=$?
    [ -z "$shader" ] || cp "shaders/$shader" "$copy/shaders/$shader"
    if [ "$code" -eq "$expected" ]; then
        echo "$name: exit code $code, as it should"
    else
        echo "$name: exit code $code, expected $expected" >&2
        cat "$copy/doctor.txt" >&2
        failed=1
    fi
}

doctor "nothing planted" 0 "" "" ""
# A sample on an edge belongs to both of its triangles, or to neither.
doctor "fill rule: all edges are in" 1 lib/rasterise/screen.wgsl 'select(-1, 0, edge.y < 0' 'select(0, 0, edge.y < 0'
doctor "fill rule: all edges are out" 1 lib/rasterise/screen.wgsl 'select(-1, 0, edge.y < 0' 'select(-1, -1, edge.y < 0'
# The last column of every triangle is lost.
doctor "coverage: one column less" 1 lib/rasterise/screen.wgsl '(high - 128) >> ' '(high - 384) >> '
exit $failed
