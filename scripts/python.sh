#!/bin/sh
# Builds the Python module as a wheel, installs it into a fresh environment, and tests it there.
#
# Wheel and environments are in target/python. The profile is `dev`, of which dependencies are likely to be built already; a wheel that is
# to be kept is built by PYTHON_PROFILE=release, as `pip install ./python` does by itself.
set -eu

cd "$(dirname "$0")/.."
cargo=${CARGO:-cargo}
python=${PYTHON:-python3}
profile=${PYTHON_PROFILE:-dev}
mkdir -p "${CARGO_TARGET_DIR:-target}"
CARGO_TARGET_DIR=$(cd "${CARGO_TARGET_DIR:-target}" && pwd)
export CARGO_TARGET_DIR
out=$CARGO_TARGET_DIR/python

"$python" -c 'import sys; sys.exit(sys.version_info < (3, 10))' || {
    echo "make python needs Python 3.10 or later: name one by PYTHON=python3.12" >&2
    exit 2
}

tools=$out/tools
[ -x "$tools/bin/maturin" ] || {
    "$python" -m venv "$tools"
    "$tools/bin/pip" install --quiet 'maturin>=1.16,<2'
}
rm -rf "$out/wheels"
"$tools/bin/maturin" build --quiet --profile "$profile" --manifest-path python/Cargo.toml --interpreter "$python" --out "$out/wheels"
ls -l "$out/wheels"

# A clean environment, into which nothing but the wheel and what it asks for is installed, says whether it stands by itself.
rm -rf "$out/clean"
"$python" -m venv "$out/clean"
"$out/clean/bin/pip" install --quiet "$out"/wheels/*.whl
"$out/clean/bin/python" -c 'import cutaway; print("cutaway", cutaway.__version__, "in", cutaway.__file__)'

# What tests and the example use beside stays from run to run.
tested=$out/tested
[ -x "$tested/bin/pip" ] || "$python" -m venv "$tested"
wheel=$(ls "$out"/wheels/*.whl)
"$tested/bin/pip" install --quiet "$wheel[test]"
"$tested/bin/pip" install --quiet --force-reinstall --no-deps "$wheel"
cd python
exec "$tested/bin/python" -m pytest "$@"
