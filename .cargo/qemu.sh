#!/usr/bin/env bash
# Runs a firmware on QEMU's mps2-an386 board and decodes its log; the exit code is the firmware's.
#
# The firmware is told the environment's TRIGGER_FAULT, a fault to plant, in its command line.
# Time is counted in instructions, 32 ns each, so that a run is the same every time.
set -u
for tool in qemu-system-arm defmt-print; do
    command -v "$tool" >/dev/null && continue
    echo "missing $tool: install your system's package of qemu-system-arm, and: cargo install --locked defmt-print" >&2
    exit 127
done
# QEMU reads two commas as one.
fault=${TRIGGER_FAULT:-}
qemu-system-arm -M mps2-an386 -nographic -monitor none -serial null -icount shift=5,sleep=off \
    -semihosting-config "enable=on,target=native,arg=TRIGGER_FAULT=${fault//,/,,}" -kernel "$1" </dev/null |
    defmt-print -e "$1"
codes=("${PIPESTATUS[@]}")
[ "${codes[0]}" -ne 0 ] && exit "${codes[0]}"
exit "${codes[1]}"
