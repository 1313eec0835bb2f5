#!/usr/bin/env bash
# The designer's tests in a real browser: Chromium, which is installed from Debian's packages where it is missing.
set -euo pipefail
cd "$(dirname "$0")"

CHROMIUM=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
if [ -z "$CHROMIUM" ]; then
    command -v apt-get >/dev/null || { echo "designer: missing Chromium" >&2; exit 1; }
    echo "designer: installing Debian's chromium, some 100 MB to fetch, a minute ..." >&2
    apt-get update >&2
    apt-get install --yes --no-install-recommends chromium >&2
    CHROMIUM=$(command -v chromium)
fi
command -v node >/dev/null || { echo "designer: missing Node.js, 20 or later" >&2; exit 1; }
# It drives that browser, and downloads none.
echo "designer: fetching what drives the browser, 20 MB, some seconds ..." >&2
npm ci --no-audit --no-fund --loglevel error

./build.sh
echo "designer: building the program that serves the page, half a minute the first time ..." >&2
cargo build --quiet --package shutter
target=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
export CHROMIUM SHUTTER="$target/debug/shutter"
node --test --test-reporter spec "$@" test/browser.test.js
