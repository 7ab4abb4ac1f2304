#!/bin/sh
# Outside baselines in one command: makes an environment with the pinned peers, unless it is there, and runs. See README.md.
# The environment is kept in $PEERS_VENV, or else target/peers-venv.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
venv=${PEERS_VENV:-$here/../../target/peers-venv}
pins=$here/requirements.txt
if ! cmp -s "$pins" "$venv/pins.txt"; then
    python3 -m venv "$venv"
    "$venv/bin/pip" install --quiet --disable-pip-version-check --requirement "$pins"
    cp "$pins" "$venv/pins.txt"
fi
# Otherwise libwayland complains on every start of a graphics driver, over ssh and in containers.
export XDG_RUNTIME_DIR="${XDG_RUNTIME_DIR:-/tmp}"
# Nothing is left beside the sources.
export PYTHONDONTWRITEBYTECODE=1
exec "$venv/bin/python" "$here/run.py" "$@"
