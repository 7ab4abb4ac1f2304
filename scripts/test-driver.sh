#!/bin/sh
# Runs the tests of exactness on another software driver than the one that is installed:
#
#   scripts/test-driver.sh swiftshader [FILTER ...]
#   scripts/test-driver.sh mesa-next [FILTER ...]
#
# SwiftShader snaps vertices to 1/16 px, which is all that Vulkan promises; Mesa's driver snaps them to 1/256. It is the library in Debian's
# package chromium, or the one that $CUTAWAY_SWIFTSHADER names. mesa-next is Mesa's driver in Debian's next release, $CUTAWAY_NEXT_RELEASE,
# with all libraries below it, which the tests are then run with. Both are unpacked into target/drivers; nothing is installed.
# What a test may forgive a driver is in tests/it/common/tolerances.rs. Exits with 3 where the driver cannot be had.
set -eu

cargo=${CARGO:-cargo}
# agree:: is of cuts, cutaways, cutters and planar too.
modules="agree:: exact:: face_cuts:: hard_cases:: rasteriser:: shared_planes:: words::"
driver=${1:?which driver: swiftshader or mesa-next}
shift
[ $# -gt 0 ] || set -- $modules

folder=${CARGO_TARGET_DIR:-target}/drivers/$driver
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
icd=$folder/icd.json
# Cargo refuses an empty list; env runs the tests as they are.
runner="['env']"

none() {
    echo "NOT CHECKED: $driver cannot be had here: $1" >&2
    exit 3
}

# Unpacks packages of a release of Debian, with all that they need, into $folder/root.
unpack() {
    release=$1
    shift
    mkdir -p "$folder/lists/partial" "$folder/archives/partial" "$folder/root"
    : >"$folder/status"
    keys=/usr/share/keyrings/debian-archive-keyring.gpg
    echo "deb [signed-by=$keys] http://deb.debian.org/debian $release main" >"$folder/sources.list"
    apt() {
        apt-get -q -o Dir::State="$folder" -o Dir::State::status="$folder/status" -o Dir::Cache="$folder" \
            -o Dir::Etc::sourcelist="$folder/sources.list" -o Dir::Etc::sourceparts=- -o APT::Sandbox::User=root \
            -o Debug::NoLocking=1 "$@" >&2
    }
    command -v apt-get >/dev/null || none "it is made of Debian's packages"
    apt update
    apt install -y --download-only --no-install-recommends "$@"
    for package in "$folder"/archives/*.deb; do
        dpkg-deb --extract "$package" "$folder/root"
    done
}

case $driver in
swiftshader)
    name=SwiftShader
    library=${CUTAWAY_SWIFTSHADER:-/usr/lib/chromium/libvk_swiftshader.so}
    if [ ! -e "$library" ]; then
        library=$folder/libvk_swiftshader.so
        if [ ! -e "$library" ]; then
            command -v apt-get >/dev/null || none "name its library by \$CUTAWAY_SWIFTSHADER"
            (cd "$folder" && { apt-get -q download chromium || { apt-get -q update && apt-get -q download chromium; }; }) >&2 ||
                none "Debian's package chromium cannot be loaded"
            dpkg-deb --fsys-tarfile "$folder"/chromium_*.deb | tar -xO ./usr/lib/chromium/libvk_swiftshader.so >"$library.part"
            mv "$library.part" "$library"
            rm "$folder"/chromium_*.deb
        fi
    fi
    ;;
mesa-next)
    name=llvmpipe
    libraries=$folder/root/usr/lib/$(uname -m)-linux-gnu
    library=$libraries/libvulkan_lvp.so
    # The tests open the loader of Vulkan by its name.
    [ -e "$library" ] || unpack "${CUTAWAY_NEXT_RELEASE:-trixie}" mesa-vulkan-drivers libvulkan1
    loader=$(ls "$libraries"/ld-linux-*.so.*)
    runner="['$loader', '--library-path', '$libraries']"
    ;;
*)
    echo "$0: there is no driver $driver: swiftshader or mesa-next" >&2
    exit 2
    ;;
esac

printf '{"file_format_version":"1.0.0","ICD":{"library_path":"%s","api_version":"1.3.0"}}\n' "$library" >"$icd"
echo "tests of $* on $name, $library" >&2
# As scripts/test.sh has it: frames leave cores idle.
export RUST_TEST_THREADS="${RUST_TEST_THREADS:-$((2 * $(getconf _NPROCESSORS_ONLN)))}"
$cargo test --quiet --workspace --test it --no-run
VK_DRIVER_FILES=$icd CUTAWAY_ADAPTER=$name XDG_RUNTIME_DIR=${XDG_RUNTIME_DIR:-/tmp} \
    $cargo --config "target.'cfg(all())'.runner = $runner" test --workspace --test it -- "$@"
