#!/bin/sh
# Makes the archive that a release offers for download: programs, manual, completions, licences, as `cargo binstall` expects them.
# It unpacks what it made and runs it.
set -eu

cargo=${CARGO:-cargo}
target=${CARGO_TARGET_DIR:-target}
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)
triple=$(rustc -vV | sed -n 's/^host: //p')
name=cutaway-v$version-$triple
out=$target/archive
suffix=
case $triple in *windows*) suffix=.exe ;; esac

$cargo build --release --quiet --package cutaway-cli --package cutaway-viewer --bins --locked
rm -rf "$out"
mkdir -p "$out/$name/completions" "$out/$name/man"
cp README.md CHANGELOG.md LICENSE-APACHE LICENSE-MIT "$out/$name"
cp "$target/release/cutaway$suffix" "$target/release/cutaway-viewer$suffix" "$out/$name"
"$target/release/cutaway" man "$out/$name/man"
for shell in bash zsh fish powershell elvish; do
    "$target/release/cutaway" completions "$shell" >"$out/$name/completions/cutaway.$shell"
done
tar -C "$out" -czf "$out/$name.tgz" "$name"

rm -rf "$out/$name"
tar -C "$out" -xzf "$out/$name.tgz"
"$out/$name/cutaway" --version
[ -s "$out/$name/cutaway-viewer$suffix" ] && [ -s "$out/$name/man/cutaway-render.1" ] && [ -s "$out/$name/completions/cutaway.fish" ]
echo "$out/$name.tgz: $(wc -c <"$out/$name.tgz") bytes; cutaway $(wc -c <"$out/$name/cutaway$suffix"), cutaway-viewer $(wc -c <"$out/$name/cutaway-viewer$suffix")"
