#!/usr/bin/env bash
# clang-tidy on the library and the command line, and through them on the headers.
#
#   lint.sh BUILD_FOLDER [JOBS]
set -euo pipefail
cd "$(dirname "$0")/.."

build=${1:?usage: lint.sh BUILD_FOLDER [JOBS]}
jobs=${2:-1}
tidy=${CLANG_TIDY:-clang-tidy-16}

# The compiler's warnings are the compiler's to give (-w), and how many there were in the system's headers is no news.
find src apps -name '*.cpp' | sort |
    xargs -P "$jobs" -n 1 "$tidy" -p "$build" --quiet --extra-arg=-w 2>&1 |
    { grep -v -E '^[0-9]+ warnings? generated\.$' || true; }
