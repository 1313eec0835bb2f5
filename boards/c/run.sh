#!/usr/bin/env bash
# Builds the library and an example in C, runs it on two emulated boards, and compares every tick with the host's.
#
#   TOOLS=gcc .ci/thumb.sh boards/c/run.sh         exits with 0 only if all ticks are the host's, to the last
#   TOOLS=gcc .ci/thumb.sh boards/c/run.sh --sizes the same, and the sizes of README.md
#
# SHUTTER_FAULT=late (or delay) has the comparison see another tick, or a delay that is forgotten, to see that it is seen.
set -euo pipefail
cd "$(dirname "$0")"
root=../..

say() { echo "c: $*" >&2; }
fail() { say "$*"; exit 1; }
for tool in arm-none-eabi-gcc arm-none-eabi-size arm-none-eabi-nm qemu-system-arm; do
    command -v $tool >/dev/null || fail "missing $tool: your system's packages gcc-arm-none-eabi, binutils-arm-none-eabi and \
qemu-system-arm, or TOOLS=gcc .ci/thumb.sh before this command"
done

scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
# The thumb target's settings of the root are for its own example.
target_folder=$(cargo metadata --no-deps --format-version 1 | sed -n 's/.*"target_directory":"\([^"]*\)".*/\1/p')
# By the host's own compiler, where .ci/thumb.sh has brought another.
plan() { (cd $root && env ${HOST_RUSTC:+RUSTC="$HOST_RUSTC"} cargo run --quiet --package shutter -- plan "$@"); }

say "planning on the host (its first build takes half a minute) ..."
speeds=("$PWD/speeds/leaf.toml" "$PWD/speeds/fast.toml")
plan "${speeds[@]}" --emit c --name camera >"$scratch/camera.h"
plan "${speeds[@]}" --emit rust --name camera | cmp - src/speeds.rs || fail "src/speeds.rs is not what plan emits of speeds/"
{
    plan "${speeds[@]}" --emit csv --name camera | awk -F, 'NR > 1 { print $5 }'
    sed 's/^min_gap.*/min_gap = 0\nduty = 0.3/' "${speeds[0]}" >"$scratch/doses.toml"
    plan "$scratch/doses.toml" --emit csv | awk -F, 'NR > 1 { print $(NF - 1), $NF }'
    echo "1 2 2 2 3 5 6 7 5 8 10 0 "
} >"$scratch/expected"
# The header is C++11 as well.
if command -v c++ >/dev/null; then
    echo '#include "shutter.h"' | c++ -std=c++11 -Wall -Wextra -pedantic -Werror -Iinclude -fsyntax-only -x c++ -
fi
# The ticks from the edge at which the header's pulses are due.
plan "${speeds[0]}" --emit csv | awk -F, 'NR > 1 { print $7 }' >"$scratch/due"
case ${SHUTTER_FAULT:-} in
"") ;;
late) sed -i '5s/[0-9]*$/1/' "$scratch/expected" ;;
delay) sed -i 's/_DELAY_TICKS UINT32_C([0-9]*)/_DELAY_TICKS UINT32_C(0)/' "$scratch/camera.h" ;;
*) fail "SHUTTER_FAULT is late or delay, not $SHUTTER_FAULT" ;;
esac

# run TARGET MACHINE FLAG...: the example on a board.
run() {
    local target=$1 machine=$2 program=$scratch/$1
    shift 2
    say "building for $target ..."
    cargo build --quiet --locked --release --target "$target"
    local c=(-std=c99 -Os -Wall -Wextra -pedantic -Werror -ffreestanding -ffunction-sections -fdata-sections -mthumb "$@")
    arm-none-eabi-gcc "${c[@]}" -Iinclude -I"$scratch" -nostdlib -Wl,--gc-sections,-z,noexecstack -T example/link.ld \
        example/startup.c example/main.c example/host.c "$target_folder/$target/release/libshutter.a" -lgcc -o "$program"
    if arm-none-eabi-nm "$program" | grep -i panic; then
        fail "the program for $target can panic"
    fi
    qemu-system-arm -M "$machine" -nographic -monitor none -serial null -icount shift=5,sleep=off \
        -semihosting-config enable=on,target=native -kernel "$program" </dev/null >"$scratch/said" 2>&1 ||
        { cat "$scratch/said" && fail "the program for $target failed"; }
    grep -v '^fired' "$scratch/said" | diff "$scratch/expected" - || fail "the ticks of $target are not the host's"
    # A pulse is at most 8 ticks late, for that long the program takes to look at the timer.
    if grep -q '^fired' "$scratch/said"; then
        grep '^fired' "$scratch/said" | paste -d' ' "$scratch/due" - |
            awk '{ late = $3 - $1; if (late < 0 || late > 8) { print "pulse " NR - 1 ": " late " ticks late"; bad = 1 } if (late > most) most = late }
                END { if (NR == 0 || bad) exit 1; print "pulses after the edge: " NR ", none early, " most " ticks late at most" }' ||
            fail "the pulses do not come at their ticks after the edge"
    fi
    echo "$target: $(grep -vc '^fired' "$scratch/said") lines of ticks, pulses and codes as on the host"
    if [ "${sizes:-}" ]; then
        arm-none-eabi-size "$program"
    fi
}

[ "${1:-}" = --sizes ] && sizes=yes
run thumbv7em-none-eabihf mps2-an386 -mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16
run thumbv6m-none-eabi microbit -mcpu=cortex-m0plus
