#!/usr/bin/env bash
# What the crate costs on microcontrollers: cycles, instructions and bytes.
#
#   benches/cortex-m/run.sh                a Cortex-M4F and a Cortex-M0+, each figure beside its budget
#   benches/cortex-m/run.sh --write-docs   five processors, beside other methods, in docs/internals/cost.md
set -euo pipefail
cd "$(dirname "$0")"

cache=${XDG_CACHE_HOME:-$HOME/.cache}/shutter-curve-thumb
case ${1:-} in
"") tools=../../.ci/thumb.sh time="two minutes" what=--budgets ;;
--write-docs) tools="../../.ci/matrix.sh all" time="ten minutes" what=$1 ;;
*) echo "usage: benches/cortex-m/run.sh [--write-docs]" >&2 && exit 2 ;;
esac
cat >&2 <<END
Measures for some $time. The first run takes some five more, to fetch what this machine lacks of a compiler with
the targets (150 MB), QEMU (20 MB), a disassembler (34 MB) and crates (10 MB). The tools are unpacked into
$cache, and nothing is installed.
END
# By the machine's own compiler, which is faster than the one that has the targets.
cargo build --quiet --release
target=${CARGO_TARGET_DIR:-target}
TOOLS="" exec $tools "$target/release/shutter-curve-cost" $what
