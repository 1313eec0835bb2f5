#!/usr/bin/env bash
# The designer's tests in real browsers: Chromium and Firefox, which are installed from Debian's packages where they are
# missing.
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
FIREFOX=$(command -v firefox-esr || command -v firefox || true)
if [ -z "$FIREFOX" ]; then
    command -v apt-get >/dev/null || { echo "designer: missing Firefox" >&2; exit 1; }
    echo "designer: installing Debian's firefox-esr, some 80 MB to fetch, a minute ..." >&2
    apt-get update >&2
    apt-get install --yes --no-install-recommends firefox-esr >&2
    FIREFOX=$(command -v firefox-esr)
fi
command -v node >/dev/null || { echo "designer: missing Node.js, 20 or later" >&2; exit 1; }
# They drive those browsers, and download none.
echo "designer: fetching what drives the browser, 20 MB, some seconds ..." >&2
npm ci --no-audit --no-fund --loglevel error

./build.sh
echo "designer: building the program that serves the page, half a minute the first time ..." >&2
cargo build --quiet --package shutter
target=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
export CHROMIUM FIREFOX SHUTTER="$target/debug/shutter"
node --test --test-concurrency=1 --test-reporter spec "$@" test/*.test.js
