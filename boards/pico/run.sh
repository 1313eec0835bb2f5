#!/usr/bin/env bash
# Builds the strobe controller, runs it on an emulated Pico, and checks every pulse, to the cycle, and every answer.
#
#   boards/pico/run.sh             exits with 0 only if every pulse comes on the cycle that `trigger_ticks` says
#   boards/pico/run.sh --jitter    the same, and the table of docs/firmware.md: state machine against alarm
#
# TRIGGER_FAULT=lost (or twice, early, late, close) plants a fault in the firmware, to see that it is seen; one build,
# apart from what is flashed, has them all. Exits with 1 then, and with 2 if there is no such fault.
set -euo pipefail
cd "$(dirname "$0")"

target=thumbv6m-none-eabi
say() { echo "pico: $*" >&2; }
fail() { say "$*"; exit 1; }

# The program alone; without a fault, the alarm beside it as well.
features=()
case ${TRIGGER_FAULT:-} in
"") ;;
lost | twice | early | late | close) features=(--bin strobe --features faults) ;;
*) say "TRIGGER_FAULT is lost, twice, early, late or close, not $TRIGGER_FAULT" && exit 2 ;;
esac

command -v node >/dev/null || fail "missing node, to run the emulator: your system's package nodejs, version 18 or later"
node --eval 'process.exit(process.versions.node.split(".")[0] >= 18 ? 0 : 1)' ||
    fail "node $(node --version) is too old: your system's package nodejs, version 18 or later"
command -v cargo >/dev/null || fail "missing cargo: https://rustup.rs"
[ -d "$("${RUSTC:-rustc}" --print target-libdir --target $target)" ] ||
    fail "missing the target: rustup target add $target (or put .ci/thumb.sh before this command)"

# The emulator, if it is not there as the lock file has it.
if ! [ emulator/node_modules/.package-lock.json -nt emulator/package-lock.json ]; then
    command -v npm >/dev/null || fail "missing npm, to fetch the emulator rp2040js: your system's package npm"
    say "fetching the emulator rp2040js ..."
    (cd emulator && npm ci --no-audit --no-fund --loglevel error >&2) || fail "npm cannot fetch the emulator rp2040js"
fi

say "building the firmware ..."
cargo build --quiet --locked --release --target $target --package firmware "${features[@]}"
folder=$(cargo metadata --no-deps --format-version 1 | node --print 'JSON.parse(fs.readFileSync(0)).target_directory')
# What has to come, by the host.
cargo run --quiet --locked --package expected >"$folder/expected.json"
node emulator/check.mjs "$folder/$target/release/strobe" "$folder/expected.json"
if [ "${1:-}" = --jitter ]; then
    node emulator/jitter.mjs "$folder/$target/release" "$folder/expected.json"
fi
