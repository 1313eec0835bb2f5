#!/usr/bin/env bash
# Builds the strobe controller, runs it on an emulated Pico, and checks every pulse, to the cycle, and every answer.
#
#   boards/pico/run.sh             exits with 0 only if every pulse comes on the cycle that `trigger_ticks` says
#   boards/pico/run.sh --second    the same, and the state machine in a second emulator (Python, with its module venv)
#   boards/pico/run.sh --jitter    the same as without, and the table of README.md: state machine against alarm
#
# TRIGGER_FAULT=lost (or twice, early, late, close, torn, full, save) plants a fault in the firmware, to see that it is seen; one
# build, apart from what is flashed, has them all. Exits with 1 then, and with 2 if there is no such fault.
#
# The first time it fetches the emulator (2 MB) and builds some 200 crates for the board, which takes a minute or two.
set -euo pipefail
cd "$(dirname "$0")"

target=thumbv6m-none-eabi
say() { echo "pico: $*" >&2; }
fail() { say "$*"; exit 1; }

# The program alone; without a fault, the alarm beside it as well, and the task of RTIC, which is linked.
what=(--package firmware --package rtic-task)
case ${TRIGGER_FAULT:-} in
"") ;;
lost | twice | early | late | close | torn | full | save) what=(--package firmware --bin strobe --features faults) ;;
*) say "TRIGGER_FAULT is lost, twice, early, late, close, torn, full or save, not $TRIGGER_FAULT" && exit 2 ;;
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
    say "fetching the emulator rp2040js, 2 MB, some seconds ..."
    (cd emulator && npm ci --no-audit --no-fund --loglevel error >&2) || fail "npm cannot fetch the emulator rp2040js"
fi

folder=$(cargo metadata --no-deps --format-version 1 | node --print 'JSON.parse(fs.readFileSync(0)).target_directory')
[ -d "$folder/$target/release" ] || say "building some 200 crates for the first time, a minute or two ..."
say "building the firmware ..."
cargo build --quiet --locked --release --target $target "${what[@]}"
# What has to come, by the host, and its own compiler where .ci/thumb.sh has brought another.
env ${HOST_RUSTC:+RUSTC="$HOST_RUSTC"} cargo run --quiet --locked --package expected >"$folder/expected.json"
strobe=$folder/$target/release/strobe
say "running it in the emulator, some 20 seconds ..."
if [ "${TRIGGER_FAULT:-}" != torn ]; then
    node emulator/check.mjs "$strobe" "$folder/expected.json"
fi
case ${TRIGGER_FAULT:-} in
"" | torn)
    say "cutting its power while it saves, some 20 seconds ..."
    node emulator/power.mjs "$strobe"
    ;;
esac
# The small one beside it, linked as it is flashed: in the same folder, for most of what it is built of is there.
if [ -z "${TRIGGER_FAULT:-}" ]; then
    (cd ../pico-embassy && CARGO_TARGET_DIR=$folder cargo build --quiet --locked --release)
    node emulator/leaf.mjs "$folder/$target/release/leaf-pico" "$folder/expected.json"
fi
if [ "${1:-}" = --second ]; then
    second=$folder/pioemu
    if [ ! -x "$second/bin/python" ] || ! "$second/bin/python" -c 'import pioemu' 2>/dev/null; then
        say "fetching the second emulator, rp2040-pio-emulator 0.88.0 and what it needs, 15 MB, some seconds ..."
        python3 -m venv "$second" && "$second/bin/pip" install --quiet --disable-pip-version-check rp2040-pio-emulator==0.88.0 ||
            fail "cannot fetch the second emulator: python3 with venv (your system's package python3-venv) and pip are needed"
    fi
    node emulator/second.mjs "$strobe" | "$second/bin/python" emulator/second.py
fi
if [ "${1:-}" = --jitter ]; then
    node emulator/jitter.mjs "$folder/$target/release" "$folder/expected.json"
fi
