#!/usr/bin/env bash
# What the crate costs on microcontrollers: cycles, instructions and bytes.
#
#   benches/cortex-m/run.sh                a Cortex-M4F and a Cortex-M0+, each figure beside its budget; two minutes
#   benches/cortex-m/run.sh --write-docs   five processors, beside other methods, in docs/internals/cost.md; ten minutes
#   benches/cortex-m/run.sh --answers      the same bits on the host and on four processors
#   benches/cortex-m/run.sh --links        no panic can be reached
#
# .ci/thumb.sh fetches what is missing, and says so: a compiler with the targets, and emulators.
cd "${BASH_SOURCE%/*}" && exec cargo run --quiet --release -- "$@"
