#!/usr/bin/env bash
# Makes docs/designer.png anew, of the page in designer/dist: the example's trace, fitted. designer/test.sh fetches what
# drives the browser.
set -euo pipefail
cd "$(dirname "$0")"
cargo build --quiet --package shutter
target=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
export CHROMIUM=${CHROMIUM:-$chromium} SHUTTER="$target/debug/shutter"
node --test test/picture.js
# A third of the size, where that is installed.
if command -v pngquant >/dev/null; then pngquant --force --output ../docs/designer.png 128 ../docs/designer.png; fi
