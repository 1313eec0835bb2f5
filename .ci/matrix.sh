#!/usr/bin/env bash
# Runs a command as thumb.sh does, with all that the same answers are looked for on, and what links and costs are.
#
#   cd benches/cortex-m && ../../.ci/matrix.sh cargo run --release -- --answers
#
# With `--all` among the arguments, what CI leaves out is set up, too.
set -euo pipefail

targets=(
    thumbv7em-none-eabihf thumbv6m-none-eabi thumbv8m.main-none-eabihf
    riscv32imc-unknown-none-elf riscv32imafc-unknown-none-elf riscv64gc-unknown-none-elf
    i686-unknown-linux-gnu s390x-unknown-linux-gnu wasm32-unknown-unknown
)
case " $* " in
*" --all "*) targets+=(powerpc-unknown-linux-gnu) ;;
esac
TARGETS=${targets[*]} exec "${0%/*}/thumb.sh" "$@"
