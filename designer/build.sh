#!/usr/bin/env bash
# Builds the curve designer into designer/dist, plain files for any web server: `shutter design` serves them here.
#
# It needs Rust with the target wasm32-unknown-unknown, and adds it by rustup where it is missing.
set -euo pipefail
cd "$(dirname "$0")"

target=wasm32-unknown-unknown
build=(cargo build --quiet --profile page --target "$target" --package designer --lib)
if [ ! -d "$(rustc --print target-libdir --target "$target")" ] &&
    echo "designer: fetching the target $target by rustup, 20 MB, some seconds ..." >&2 && ! rustup target add "$target"; then
    # Without it, the standard library can be compiled where its source is there: rustup's, or that of Debian's compiler.
    if [ ! -d "$(rustc --print sysroot)/lib/rustlib/src/rust/library" ]; then
        RUSTC=$(TARGETS=$target ../.ci/thumb.sh sh -c 'echo "${RUSTC:-}"') && [ -n "$RUSTC" ] || {
            echo "designer: missing the target $target: rustup target add $target (or rustup component add rust-src)" >&2
            exit 1
        }
        build=(env RUSTC="$RUSTC" "${build[@]}")
    fi
    echo "designer: the standard library for the page is compiled as well, another minute" >&2
    export RUSTC_BOOTSTRAP=1
    build+=(-Zbuild-std=std,panic_abort)
fi

echo "designer: building the page, in two parts, a minute or two the first time ..." >&2
rm -rf dist.files
mkdir dist.files
cp page/* ../cli/traces/leaf.csv dist.files
cargo run --quiet --package designer --bin presets >dist.files/presets.js
built=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')/$target/page/designer.wasm
# First what the page begins with, then what it loads when that is asked for.
"${build[@]}"
cp "$built" dist.files/engine.wasm
"${build[@]}" --features studio
cp "$built" dist.files/studio.wasm
./pack.sh dist.files dist
rm -rf dist.files
echo "designer: built designer/dist" >&2
