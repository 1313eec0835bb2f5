#!/usr/bin/env bash
# Builds the firmware with its src/leaf.rs (README.md) as it is flashed, and runs it on an emulated Pico: exits with 0
# only if each edge of the lamp's line comes on its cycle. The first time it fetches the emulator rp2040js, 2 MB, with
# npm.
#
#   .ci/thumb.sh boards/pico/run.sh     or without .ci/thumb.sh, after: rustup target add thumbv6m-none-eabi
set -euo pipefail
cd "$(dirname "$0")"

command -v npm >/dev/null || { echo "pico: missing node and npm, version 18 or later, for the emulator" >&2 && exit 1; }
echo "pico: building the firmware ..." >&2
# Else cargo takes for this firmware what a copy of this folder has built in the same target folder.
touch src/main.rs
cargo build --quiet --locked --release
[ emulator/node_modules/.package-lock.json -nt emulator/package-lock.json ] ||
    (cd emulator && npm ci --no-audit --no-fund --loglevel error >&2)
folder=$(cargo metadata --no-deps --format-version 1 | sed -n 's/.*"target_directory":"\([^"]*\)".*/\1/p')
node emulator/check.mjs "$folder/thumbv6m-none-eabi/release/leaf-pico" src "$@"
