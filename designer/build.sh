#!/usr/bin/env bash
# Builds the curve designer into designer/dist, plain files for any web server; `--serve` serves them here.
#
# It needs Rust with the target wasm32-unknown-unknown, and adds it by rustup where it is missing.
set -euo pipefail
cd "$(dirname "$0")"

target=wasm32-unknown-unknown
build=(cargo build --quiet --profile page --target "$target" --package designer --lib)
if [ ! -d "$(rustc --print target-libdir --target "$target")" ] &&
    echo "designer: fetching the target $target by rustup, 20 MB, some seconds ..." >&2 &&
    ! rustup target add "$target"; then
    # Without it, the standard library can be compiled where its source is there: rustup's, or Debian's compiler's.
    if [ ! -d "$(rustc --print sysroot)/lib/rustlib/src/rust/library" ]; then
        RUSTC=$(TARGETS=$target TOOLS= ../.ci/thumb.sh sh -c 'echo "${RUSTC:-}"') && [ -n "$RUSTC" ] || {
            echo "designer: missing the target: rustup target add $target (or rustup component add rust-src)" >&2
            exit 1
        }
        build=(env RUSTC="$RUSTC" "${build[@]}")
    fi
    echo "designer: the standard library for the page is compiled as well, another minute" >&2
    export RUSTC_BOOTSTRAP=1
    build+=(-Zbuild-std=std,panic_abort)
fi

command -v npm >/dev/null || { echo "designer: missing Node.js, 20 or later" >&2; exit 1; }
if [ ! -x node_modules/.bin/esbuild ] || [ package-lock.json -nt node_modules ]; then
    echo "designer: fetching what joins its scripts and drives a browser, 30 MB, some seconds ..." >&2
    npm ci --no-audit --no-fund --loglevel error
    touch node_modules
fi

echo "designer: building the page, in two parts, a minute or two the first time ..." >&2
rm -rf dist.new
mkdir dist.new
files=dist.new/files
mkdir $files
cp page/icon.svg ../cli/traces/leaf.csv $files
folder=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
cargo run --quiet --package designer --bin presets >dist.new/presets.json
# First what the page begins with, then what it loads when that is asked for.
for part in engine studio; do
    "${build[@]}" $([ $part = engine ] || echo --features $part)
    cargo run --quiet --package designer --features bind --bin bind -- \
        "$folder/$target/page/designer.wasm" dist.new/bound $part
    mv dist.new/bound/${part}_bg.wasm $files/$part.wasm
done
npx esbuild page/main.js page/worker.js page/style.css --bundle --minify --format=esm --target=es2023 \
    --log-level=warning --outdir=$files "--alias:presets=$PWD/dist.new/presets.json" \
    "--alias:engine=$PWD/dist.new/bound/engine.js" "--alias:studio=$PWD/dist.new/bound/studio.js"
rm -r dist.new/presets.json dist.new/bound

# All but the page itself stands in a folder that is called by its content: what an old index.html names is never a new
# file, however long a host lets browsers keep either.
sum() { if command -v sha256sum >/dev/null; then sha256sum; else shasum -a 256; fi; }
version=$(cat page/index.html $files/* | sum | cut -c 1-12)
sed -E "s/^ +//; s|@version@|$version|g" page/index.html >dist.new/index.html
mv $files dist.new/"$version"
rm -rf dist
mv dist.new dist
echo "designer: built designer/dist" >&2
if [ "${1:-}" = --serve ]; then exec npx esbuild --servedir=dist --serve=127.0.0.1:8417; fi
