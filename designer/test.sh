#!/usr/bin/env bash
# The designer's tests in real browsers: Chromium and Firefox, which are installed from Debian's packages where they are
# missing. With `picture`, docs/designer.png is made anew instead.
set -euo pipefail
cd "$(dirname "$0")"

# The first of a package's commands; the package's name is the first of them.
browser() {
    for name; do command -v "$name" && return; done
    command -v apt-get >/dev/null || { echo "designer: missing $1" >&2; exit 1; }
    echo "designer: installing Debian's $1, some 100 MB to fetch, a minute ..." >&2
    apt-get update >&2
    apt-get install --yes --no-install-recommends "$1" >&2
    command -v "$1"
}
CHROMIUM=$(browser chromium chromium-browser google-chrome)
FIREFOX=$(browser firefox-esr firefox)
./build.sh
echo "designer: building the program that the page agrees with, half a minute the first time ..." >&2
cargo build --quiet --package shutter-curve-cli
target=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
export CHROMIUM FIREFOX SHUTTER="$target/debug/shutter"
files=(test/*.test.js)
if [ "${1:-}" = picture ]; then shift; files=(test/picture.js); fi
node --test --test-concurrency=1 --test-reporter spec "$@" "${files[@]}"
