#!/bin/sh
# Runs the tests of the Python package against what is installed: from a scratch folder, where the source tree cannot be
# imported by mistake.
#
#   test-wheel.sh BIN [pytest's arguments]    BIN has the environment's python and footfall
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
bin=$(cd "$1" && pwd)
shift

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp -r "$root/python/tests" "$root/examples/python" "$root/python/README.md" "$scratch"
cd "$scratch"
PATH="$bin:$PATH" "$bin/python" -m pytest -q -p no:cacheprovider "$@" tests
