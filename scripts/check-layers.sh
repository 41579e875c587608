#!/bin/sh
# Data goes one way: a folder of include/footfall or src includes only from itself and from those above it in this
# list. Files that lie directly in include/footfall belong to no layer: any file may include version.hpp, none another.
# Only law/ asks what kind of law it has. No file is longer than 500 lines.
set -eu
cd "$(dirname "$0")/.."

layers="math eigen solve material law body energy surface plant simulate host study io"

find include/footfall src \( -name '*.hpp' -o -name '*.cpp' -o -name '*.in' \) | sort | xargs awk -v layers="$layers" '
    BEGIN {
        n = split(layers, name, " ")
        for (i = 1; i <= n; i++) rank[name[i]] = i
        kinds = "has_(states|clutch|bristle)|begin_impact|(Rate|Clutch|Coupled)Friction|FrictionPart|NormalPart"
    }
    FNR == 1 {
        path = FILENAME
        sub(/^(include\/footfall|src)\//, "", path)
        here = path ~ /\// ? substr(path, 1, index(path, "/") - 1) : ""
        if (here != "" && !(here in rank)) fail("is in no known layer (" layers ")")
    }
    /^[ \t]*#[ \t]*include[ \t]*"/ {
        split($0, quoted, "\"")
        target = quoted[2]
        sub(/^footfall\//, "", target)
        if (target == "version.hpp") next
        if (target ~ /\//) {  # without a folder it is a neighbour
            there = substr(target, 1, index(target, "/") - 1)
            if (!(there in rank)) fail("includes \"" quoted[2] "\", which is in no known layer")
            else if (here != "" && rank[there] > rank[here]) fail(here "/ includes from " there "/, which is below it")
        }
    }
    here ~ /^(solve|plant|simulate|study)$/ && match($0, kinds) {
        fail("asks for a kind of law: " substr($0, RSTART, RLENGTH))
    }
    FNR == 501 { fail("is longer than 500 lines") }
    function fail(what) {
        print FILENAME ":" FNR ": " what
        failures++
    }
    END { exit failures > 0 }
'
echo "layers: every include goes one way, and only law/ asks for the kind of a law"
