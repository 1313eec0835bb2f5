#!/usr/bin/env bash
# Runs a command with what the firmware needs: a compiler that has the thumb targets, QEMU, a disassembler
# and the log decoder.
#
#   .ci/thumb.sh cargo run --release --target thumbv7em-none-eabihf --example trigger
#
# What the machine has is used as it is (`rustup target add ...`, the system's qemu-system-arm,
# llvm-objdump and defmt-print). What is missing is unpacked from Debian's packages, or built, into a
# cache folder; nothing is installed. The settings last for the command alone.
set -euo pipefail

targets=(thumbv7em-none-eabihf thumbv6m-none-eabi)
cache=${XDG_CACHE_HOME:-$HOME/.cache}/shutter-curve-thumb
host=$(rustc -vV | sed -n 's/^host: //p')
bin=$cache/bin

say() { echo "thumb: $*" >&2; }
fail() { say "$*"; exit 1; }

has_apt() { command -v apt-get >/dev/null && command -v dpkg >/dev/null; }

# unpack NAME HINT PACKAGE...: the Debian packages, unpacked into the cache folder NAME.
# With dependencies where NAME ends in '+': those that are not installed.
unpack() {
    local name=$1 hint=$2; shift 2
    local folder=$cache/${name%+}
    [ -e "$folder" ] && return
    has_apt || fail "missing $hint"
    say "unpacking Debian's $* ..."
    local work
    work=$(mktemp -d "$cache/tmp.XXXXXX")
    mkdir -p "$work/debs/partial" "$work/root"
    if [ -z "$(apt-cache policy "$1" 2>/dev/null | sed -n 's/^ *Candidate: *//p' | grep -v none)" ]; then
        apt-get update >&2 || fail "apt-get update failed; it is needed to find $1"
    fi
    if [ "$name" != "${name%+}" ]; then
        apt-get install --yes --download-only --no-install-recommends -o Debug::NoLocking=true \
            -o Dir::Cache::archives="$work/debs" "$@" >"$work/log" 2>&1
    else
        (cd "$work/debs" && apt-get download "$@") >"$work/log" 2>&1
    fi || { cat "$work/log" >&2; fail "cannot download Debian's $*; missing $hint"; }
    local deb
    for deb in "$work"/debs/*.deb; do dpkg -x "$deb" "$work/root"; done
    mv "$work/root" "$folder"
    rm -r "$work"
}

# depends PACKAGE PATTERN: the package that PACKAGE depends on whose name has the PATTERN.
depends() {
    apt-cache depends "$1" | sed -n "s/^ *Depends: \($2\)\$/\1/p" | grep . ||
        fail "Debian's $1 depends on no $2 here; missing it, or run apt-get update"
}

# wrap NAME LIBRARIES PROGRAM [ARGUMENT...]: the unpacked PROGRAM as the command NAME.
wrap() {
    local name=$1 libraries=$2; shift 2
    [ -x "$1" ] || fail "the unpacked packages hold no $1"
    mkdir -p "$bin"
    {
        echo '#!/bin/sh'
        echo "LD_LIBRARY_PATH='$libraries' exec$(printf " '%s'" "$@") \"\$@\""
    } >"$bin/$name"
    chmod +x "$bin/$name"
}

# Debian's rustc, with a core library compiled for each target and put where rustup would put it.
set_up_rustc() {
    [ -e "$cache/rustc.ready" ] && return
    local hint="the targets: rustup target add ${targets[*]} (or Debian's rustc-web and rust-web-src)"
    has_apt || fail "missing $hint"
    local std llvm
    if ! apt-cache show rustc-web >/dev/null 2>&1; then apt-get update >&2 || fail "apt-get update failed; missing $hint"; fi
    std=$(depends libstd-rust-web-dev 'libstd-rust-web-[0-9.]*')
    llvm=$(depends "$std" 'libllvm[0-9]*')
    rm -rf "$cache/rustc"
    unpack rustc "$hint" rustc-web libstd-rust-web-dev "$std" "$llvm" rust-web-src
    local root=$cache/rustc/usr
    wrap rustc "$root/lib/$(uname -m)-linux-gnu" "$root/bin/rustc"
    local lld
    lld=$(rustc --print sysroot)/lib/rustlib/$host/bin/rust-lld
    [ -x "$lld" ] || fail "no rust-lld in rustup's toolchain, nor the targets: rustup target add ${targets[*]}"
    mkdir -p "$root/lib/rustlib/$host/bin"
    ln -sf "$lld" "$root/lib/rustlib/$host/bin/rust-lld"

    say "compiling core for ${targets[*]} ..."
    local work target
    work=$(mktemp -d "$cache/tmp.XXXXXX")
    mkdir "$work/src"
    echo '#![no_std]' >"$work/src/lib.rs"
    printf '[package]\nname="empty"\nedition="2024"\n[profile.release]\ncodegen-units=1\n[workspace]\n' >"$work/Cargo.toml"
    for target in "${targets[@]}"; do
        (cd "$work" && RUSTC=$bin/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_DIR=$work/target RUSTFLAGS="-C embed-bitcode=yes" \
            cargo build --quiet --release -Zbuild-std=core --target "$target") >&2 ||
            fail "cannot compile core for $target with Debian's rustc-web"
        mkdir -p "$root/lib/rustlib/$target/lib"
        cp "$work/target/$target/release/deps/"lib{core,compiler_builtins}-*.r{lib,meta} "$root/lib/rustlib/$target/lib"
    done
    rm -r "$work"
    touch "$cache/rustc.ready"
}

mkdir -p "$cache"
for target in "${targets[@]}"; do
    if [ ! -d "$(rustc --print target-libdir --target "$target")" ]; then
        set_up_rustc
        export RUSTC=$bin/rustc
        break
    fi
done

if ! command -v qemu-system-arm >/dev/null && [ ! -x "$bin/qemu-system-arm" ]; then
    unpack qemu+ "qemu-system-arm: Debian's package qemu-system-arm" qemu-system-arm
    wrap qemu-system-arm "$cache/qemu/usr/lib/$(uname -m)-linux-gnu:$cache/qemu/lib/$(uname -m)-linux-gnu" \
        "$cache/qemu/usr/bin/qemu-system-arm" -L "$cache/qemu/usr/share/qemu"
fi

if ! command -v llvm-objdump >/dev/null && [ ! -x "$bin/llvm-objdump" ]; then
    tools=$(rustc --print sysroot)/lib/rustlib/$host/bin/llvm-objdump
    if [ -x "$tools" ]; then
        mkdir -p "$bin" && ln -sf "$tools" "$bin/llvm-objdump"
    else
        unpack llvm+ "llvm-objdump: rustup component add llvm-tools, or Debian's package llvm" llvm
        # The unversioned package's command is a link to the versioned one's.
        objdump=$(ls "$cache"/llvm/usr/lib/llvm-*/bin/llvm-objdump)
        wrap llvm-objdump "$cache/llvm/usr/lib/$(uname -m)-linux-gnu" "$objdump"
    fi
fi

if ! command -v defmt-print >/dev/null && [ ! -x "$bin/defmt-print" ]; then
    say "building defmt-print ..."
    cargo install --quiet --locked --root "$cache" defmt-print --version '^1' >&2 ||
        fail "missing defmt-print: cargo install --locked defmt-print"
fi

export PATH=$bin:$PATH
[ $# -gt 0 ] && exec "$@"
say "ready"
