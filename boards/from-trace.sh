#!/usr/bin/env bash
# The whole way, as a user goes it: a record with a noisy sync that falls and five shots whose delay jitters, `fit --sync CH2`,
# `plan --emit rust`, copies of boards/stm32f4 and boards/pico with the edits for a falling edge that their READMEs name, linked,
# and run where their emulators run. Exits with 0 only if the spread is the one that was put in, and each pulse comes on its tick after
# the edge.
#
#   .ci/thumb.sh boards/from-trace.sh      node and Python are needed
set -euo pipefail
cd "$(dirname "$0")/.."

crate=$PWD
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
shutter() { env ${HOST_RUSTC:+RUSTC="$HOST_RUSTC"} cargo run --quiet --locked -- "$@"; }
# copy BOARD HERTZ: the project with the scene's ticks.
copy() {
    cp -r "boards/$1" "$scratch/$1"
    rm -rf "$scratch/$1/target"
    sed -i "s|path = \"../..\"|path = \"$crate\"|" "$scratch/$1/Cargo.toml"
    shutter plan "$scratch/leaf.toml" --timer-hz "$2" --triggers 8 --min-gap 100us --emit rust --to "$scratch/leaf.rs" --force
    python3 boards/from-trace.py judge "$scratch"
    cp "$scratch/leaf.rs" "$scratch/$1/src/leaf.rs"
}

python3 boards/from-trace.py record "$scratch"
shutter fit "$scratch/record.csv" --sync CH2 --out "$scratch/leaf.toml" | grep -E '^(sync|delay|spread| +falls)'

copy stm32f4 100MHz
sed -i 's/w.cc1e().enabled()/w.cc1p().falling_edge().cc1e().enabled()/; s/Pull::Down/Pull::Up/' "$scratch/stm32f4/src/main.rs"
CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$crate/boards/stm32f4/target} "$scratch/stm32f4/run.sh" falling

copy pico 125MHz
sed -i 's/^\( *wait\) 0 /\1 x /; s/^\( *wait\) 1 /\1 0 /; s/^\( *wait\) x /\1 1 /' "$scratch/pico/src/pulses.pio"
sed -i 's/Pull::Down/Pull::Up/' "$scratch/pico/src/main.rs"
printf '\n#[allow(dead_code)]\npub const SYNC_FALLS: bool = true;\n' >>"$scratch/pico/src/leaf.rs"
CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$crate/boards/pico/target} "$scratch/pico/run.sh"
