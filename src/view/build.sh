#!/usr/bin/env bash
# Bundles the libraries of the page into libraries.js.gz and their style sheet into uPlot.css; needs node and npm.
# With --check: compares the committed files with those that are built anew, in a folder that goes afterwards.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cp "$here/entry.js" "$here/package.json" "$here/package-lock.json" "$work"
cd "$work"
npm ci --no-audit --no-fund --loglevel=error
npx esbuild entry.js --bundle --minify --format=iife --global-name=L --legal-comments=none --outfile=libraries.js \
    --log-level=warning
{
    echo "three.js $(node -p 'require("./package.json").dependencies.three')"
    cat node_modules/three/LICENSE
    echo
    echo "uPlot $(node -p 'require("./package.json").dependencies.uplot')"
    cat node_modules/uplot/LICENSE
} > LICENSES.txt
cp node_modules/uplot/dist/uPlot.min.css uPlot.css

if [ "${1:-}" = --check ]; then
    gunzip -c "$here/libraries.js.gz" | cmp - libraries.js
    cmp "$here/uPlot.css" uPlot.css
    cmp "$here/LICENSES.txt" LICENSES.txt
    echo "the committed libraries are what their sources give"
else
    gzip -9 -n -c libraries.js > "$here/libraries.js.gz"
    cp uPlot.css LICENSES.txt "$here"
fi
