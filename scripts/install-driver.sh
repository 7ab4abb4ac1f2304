#!/bin/sh
# Installs Mesa's software Vulkan driver where no Vulkan driver is found. Does nothing on machines that have one, and on
# systems that draw by something else (macOS by Metal, Windows by Direct3D).
set -eu

[ "$(uname -s)" = Linux ] || exit 0

# A driver named by the environment wins over whatever is installed.
for list in "${VK_DRIVER_FILES:-}" "${VK_ICD_FILENAMES:-}"; do
    [ -z "$list" ] || exit 0
done
for folder in /usr/share/vulkan/icd.d /etc/vulkan/icd.d /usr/local/share/vulkan/icd.d "${HOME:-/root}/.local/share/vulkan/icd.d"; do
    for driver in "$folder"/*.json; do
        [ ! -e "$driver" ] || exit 0
    done
done

if command -v apt-get >/dev/null; then
    package=mesa-vulkan-drivers
    install="apt-get install -y --no-install-recommends libvulkan1 $package"
    refresh="apt-get update"
elif command -v dnf >/dev/null; then
    package=mesa-vulkan-drivers
    install="dnf install -y vulkan-loader $package"
    refresh=true
elif command -v pacman >/dev/null; then
    package=vulkan-swrast
    install="pacman -S --noconfirm --needed vulkan-icd-loader $package"
    refresh=true
else
    echo "no Vulkan driver found: install Mesa's software driver, lavapipe, with your package manager" >&2
    exit 1
fi

if [ "$(id -u)" -eq 0 ]; then
    as_root=
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
    as_root=sudo
else
    echo "no Vulkan driver found: install the package $package, for example with: sudo $install" >&2
    exit 1
fi

echo "no Vulkan driver found: installing $package" >&2
# Words of a command, split on purpose; an old package list is worth a try where no new one can be had.
$as_root $refresh >&2 || true
$as_root $install >&2
