#!/usr/bin/env bash
# Runs a command as thumb.sh does, with the targets on which answers, links and costs are looked for.
#
#   cd benches/cortex-m && ../../.ci/matrix.sh some cargo run --release -- --answers
#
# `some` are those that CI runs; `all` adds the rest.
set -euo pipefail

targets=(
    thumbv7em-none-eabihf thumbv6m-none-eabi riscv32imc-unknown-none-elf s390x-unknown-linux-gnu wasm32-unknown-unknown
)
case ${1:-} in
some) ;;
all)
    targets+=(
        thumbv8m.main-none-eabihf riscv32imafc-unknown-none-elf riscv64gc-unknown-none-elf i686-unknown-linux-gnu
        powerpc-unknown-linux-gnu
    )
    ;;
*) echo "usage: matrix.sh some|all COMMAND" >&2 && exit 2 ;;
esac
shift
TARGETS=${targets[*]} exec "${BASH_SOURCE%/*}/thumb.sh" "$@"
