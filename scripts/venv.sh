#!/bin/sh
# Makes a virtual environment with what a requirements file lists, or brings it up to date.
#
#   venv.sh DIR REQUIREMENTS
#
# Does nothing, and needs no network, where DIR has already been made from the same file. On Debian and Ubuntu the
# package python3-venv is needed.
set -eu

if [ $# -ne 2 ]; then
    echo "venv.sh: usage: venv.sh DIR REQUIREMENTS" >&2
    exit 2
fi
folder=$1
requirements=$2
made_from="$folder/requirements.txt"

cmp -s "$requirements" "$made_from" && exit 0
python3 -m venv "$folder"
"$folder/bin/python" -m pip install --quiet --disable-pip-version-check -r "$requirements"
cp "$requirements" "$made_from"
