#!/usr/bin/env bash
# The whole way, as a user goes it: a record of five shots whose delay jitters, with a noisy sync that falls (and one
# that rises), then `shutter fit --sync`, `shutter plan --emit rust`, and copies of boards/stm32f4 and boards/pico with
# that module, linked, and run where their emulators run. Exits with 0 only if the numbers are those that were put in,
# each edge of the lamp's line comes on its tick after the sync's, and what would fire wrongly is refused.
#
#   .ci/thumb.sh boards/from-trace.sh      node and Python are needed
set -euo pipefail
cd "$(dirname "$0")"

scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/../target}
shutter=$CARGO_TARGET_DIR/debug/shutter
fail() { printf 'from-trace: %s\n' "$*" >&2 && exit 1; }

# refused TEXT COMMAND...: the command fails, and says that.
refused() {
    local text=$1 said
    shift
    ! said=$("$@" 2>&1) || fail "not refused: $*"
    grep -qF -- "$text" <<<"$said" || fail "$* does not say '$text', but: $said"
    echo "from-trace: refused: $text"
}
# plan WAY BOARD HERTZ OPTION...: the record with that sync as the board's module.
plan() {
    "$shutter" plan "$scratch/$1.toml" --timer-hz "$3" "${@:4}" --emit rust --to "$scratch/$2/src/leaf.rs"
}
# fire WAY BOARD HERTZ OPTION...: the same, judged, and each edge.
fire() {
    plan "$@"
    python3 from-trace.py judge "$1" "$scratch/$1.toml" "$scratch/$2/src/leaf.rs"
    "$scratch/$2/run.sh"
}
triggers=(--set-up emulated --triggers 8 --min-gap 100us)
pulses=(--set-up in_path --triggers 8 --min-gap 100us --duty 0.3)

env ${HOST_RUSTC:+RUSTC="$HOST_RUSTC"} cargo build --quiet --locked --package shutter-curve-cli
python3 from-trace.py record "$scratch"
"$shutter" fit "$scratch/record.csv" --sync CH2 --out "$scratch/falling.toml" | grep -E '^(sync|delay|spread| +falls)'
"$shutter" fit "$scratch/record.csv" --sync CH3 --out "$scratch/rising.toml" | grep -E '^ +rises'
cp -r stm32f4 pico "$scratch"
rm -rf "$scratch"/*/target

refused "timer_hz" "$shutter" plan "$scratch/falling.toml" "${triggers[@]}" --emit rust
refused "set_up" plan falling stm32f4 100MHz --triggers 8
refused "plan it with timer_hz = 100_000_000" fire falling stm32f4 125MHz "${triggers[@]}"
refused "plan it with timer_hz = 125_000_000" fire falling pico 100MHz "${triggers[@]}"
for board in "stm32f4 100MHz" "pico 125MHz"; do
    read -r board hertz <<<"$board"
    fire rising "$board" "$hertz" "${pulses[@]}"
    fire falling "$board" "$hertz" "${triggers[@]}"
    refused "a flash comes too soon" fire falling "$board" "$hertz" --set-up emulated --min-gap 0 --triggers 4000
    # Firmware that takes the rising edge of every sync.
    plan falling "$board" "$hertz" "${pulses[@]}"
    sed -i 's/bit(leaf::SYNC_FALLS)/bit(false)/; s/if leaf::SYNC_FALLS {$/if false {/' "$scratch/$board/src/main.rs"
    said=$([ "$board" = pico ] && echo "frame 0: the line changes at" || echo "captures the other edges")
    refused "$said" "$scratch/$board/run.sh"
done
echo "from-trace: triggers and pulses on their ticks, by a falling and a rising sync, from both boards"
