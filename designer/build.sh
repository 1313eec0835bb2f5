#!/usr/bin/env bash
# Builds the curve designer into designer/dist, plain files for any web server: `shutter design` serves them here.
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
        RUSTC=$(TARGETS=$target ../.ci/thumb.sh sh -c 'echo "${RUSTC:-}"') && [ -n "$RUSTC" ] || {
            echo "designer: missing the target: rustup target add $target (or rustup component add rust-src)" >&2
            exit 1
        }
        build=(env RUSTC="$RUSTC" "${build[@]}")
    fi
    echo "designer: the standard library for the page is compiled as well, another minute" >&2
    export RUSTC_BOOTSTRAP=1
    build+=(-Zbuild-std=std,panic_abort)
fi

echo "designer: building the page, in two parts, a minute or two the first time ..." >&2
rm -rf dist.new
mkdir dist.new
files=dist.new/files
mkdir $files
cp page/icon.svg page/worker.js ../cli/traces/leaf.csv $files
sed -E 's/^ +//; /^\/\*.*\*\/$/d' page/style.css >$files/style.css
folder=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
built=$folder/$target/page/designer.wasm
# First what the page begins with, then what it loads when that is asked for.
"${build[@]}"
cp "$built" $files/engine.wasm
"${build[@]}" --features studio
cp "$built" $files/studio.wasm

# One script: the modules one after the other, whose outermost names differ; the renderer within a function.
{
    cargo run --quiet --package designer --bin presets | sed 's/^export default /const presets = /; s/^export //'
    echo 'const { html, nothing, render } = (() => {'
    exported='export{.*b as html.*A as nothing.*D as render.*};'
    sed "s/$exported/return { html: b, nothing: A, render: D };/" page/lit-html.js
    echo '})();'
    for module in dom scene view model graph handles photo facts words numbers studio form trace speeds export bar \
        ticks main; do
        sed -E '/^import .* from /d; /^import \{$/,/^\} from /d; /^ *\/\//d; s/^export //' "page/$module.js"
    done | awk '/^ *\/\*\*/ { inside = 1 } !inside { sub(/^ +/, ""); print } /\*\/ *$/ { inside = 0 }'
} >$files/page.js

# All but the page itself stands in a folder that is called by its content: what an old index.html names is never a new
# file, however long a host lets browsers keep either.
sum() { if command -v sha256sum >/dev/null; then sha256sum; else shasum -a 256; fi; }
version=$(cat page/index.html $files/* | sum | cut -c 1-12)
sed -E "s/^ +//; s|@version@|$version|g" page/index.html >dist.new/index.html
mv $files dist.new/"$version"
rm -rf dist
mv dist.new dist
echo "designer: built designer/dist" >&2
