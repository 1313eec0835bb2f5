#!/usr/bin/env bash
# Runs a command with what the firmware needs: a compiler that has the targets, its clippy, QEMU and the log decoder.
#
#   .ci/thumb.sh cargo trigger
#   TARGETS="thumbv7em-none-eabihf riscv32imc-unknown-none-elf" .ci/thumb.sh COMMAND
#   TOOLS=linux .ci/thumb.sh COMMAND           with QEMU's user mode, in place of its boards and the log decoder
#
# What the machine has is used as it is. A missing target is added by rustup; where that cannot fetch it, Debian's
# compiler is unpacked into a cache folder, and so are QEMU and the log decoder if they are missing: neither is
# installed. The settings last for the command alone.
set -euo pipefail

read -ra targets <<<"${TARGETS:-thumbv7em-none-eabihf thumbv6m-none-eabi}"
cache=${XDG_CACHE_HOME:-$HOME/.cache}/shutter-curve-thumb
bin=$cache/bin
# Debian's compiler lies apart: it is used only where the machine's own lacks the targets.
compiler=$cache/compiler
debian=$(uname -m)-linux-gnu

say() { echo "thumb: $*" >&2; }
fail() { say "$*"; exit 1; }
has() { command -v "$1" >/dev/null; }

# unpack NAME HINT COST PACKAGE...: Debian's packages, with the dependencies that are not installed, unpacked into the
# cache folder NAME; COST is said before.
unpack() {
    local name=$1 hint=$2 cost=$3; shift 3
    has apt-get && has dpkg || fail "missing $hint"
    say "fetching and unpacking Debian's $* into $cache: $cost ..."
    local work deb
    work=$(mktemp -d "$cache/tmp.XXXXXX")
    mkdir -p "$work/debs/partial" "$work/root"
    # Old lists may name an older compiler than the crate needs, or none.
    { apt-get update && apt-get install --yes --download-only --no-install-recommends -o Debug::NoLocking=true \
        -o Dir::Cache::archives="$work/debs" "$@"; } >"$work/log" 2>&1 ||
        { cat "$work/log" >&2; fail "cannot download Debian's $*; missing $hint"; }
    for deb in "$work"/debs/*.deb; do dpkg -x "$deb" "$work/root"; done
    rm -rf "${cache:?}/$name"
    mv "$work/root" "$cache/$name"
    rm -r "$work"
}

# wrap COMMAND LIBRARIES PROGRAM [ARGUMENT...]: the unpacked PROGRAM as COMMAND.
wrap() {
    local command=$1 libraries=$2; shift 2
    [ -x "$1" ] || fail "the package of ${command##*/} holds no $1; remove $cache to unpack it again"
    mkdir -p "${command%/*}"
    printf '#!/bin/sh\nLD_LIBRARY_PATH=%q exec %s "$@"\n' "$libraries" "$(printf '%q ' "$@")" >"$command"
    chmod +x "$command"
}

# Debian's rustc and clippy, with a core library compiled for each target and put where rustup would put it.
set_up_rustc() {
    local hint="the targets: rustup target add ${targets[*]} (or Debian's rustc-web and rust-web-src)"
    local root=$compiler/usr tool
    if [ ! -e "$compiler.ready" ]; then
        unpack compiler "$hint" "140 MB to fetch, 1.1 GB unpacked, a minute or two" \
            rustc-web rust-web-clippy libstd-rust-web-dev rust-web-src
        for tool in rustc cargo-clippy; do wrap "$compiler/bin/$tool" "$root/lib/$debian" "$root/bin/$tool"; done
    fi
    # The linker is rustup's, and rustup may have removed the toolchain that it was in.
    local host lld linker
    host=$(rustc -vV | sed -n 's/^host: //p')
    linker=$root/lib/rustlib/$host/bin/rust-lld
    if [ ! -x "$linker" ]; then
        lld=$(rustc --print sysroot)/lib/rustlib/$host/bin/rust-lld
        [ -x "$lld" ] || fail "no rust-lld at $lld (rustup's toolchains have one); missing $hint"
        mkdir -p "${linker%/*}"
        ln -sfn "$lld" "$linker"
    fi
    touch "$compiler.ready"

    local work target missing=()
    for target in "${targets[@]}"; do
        [ -d "$root/lib/rustlib/$target/lib" ] || missing+=("$target")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    say "compiling core for ${missing[*]}: half a minute each ..."
    work=$(mktemp -d "$cache/tmp.XXXXXX")
    mkdir "$work/src"
    echo '#![no_std]' >"$work/src/lib.rs"
    {
        printf '[package]\nname="empty"\nedition="2024"\n[workspace]\n'
        printf '[profile.release]\ncodegen-units=1\npanic="abort"\n'
    } >"$work/Cargo.toml"
    # What the compiler calls to copy memory is in no other library of such a program.
    (cd "$work" && RUSTC=$compiler/bin/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_DIR=$work/target \
        RUSTFLAGS="-C embed-bitcode=yes" cargo build --quiet --release -Zbuild-std=core \
        -Zbuild-std-features=compiler-builtins-mem "${missing[@]/#/--target=}") >&2 ||
        fail "cannot compile core for ${missing[*]} with Debian's rustc-web"
    for target in "${missing[@]}"; do
        mkdir -p "$work/lib" "$root/lib/rustlib/$target"
        cp "$work/target/$target/release/deps/"lib{core,compiler_builtins}-*.r{lib,meta} "$work/lib"
        mv "$work/lib" "$root/lib/rustlib/$target/lib"
    done
    rm -r "$work"
}

lacks_targets() {
    local target
    for target in "${targets[@]}"; do
        [ -d "$(rustc --print target-libdir --target "$target")" ] || return 0
    done
    return 1
}

for tool in rustc cargo; do has $tool || fail "missing $tool: https://rustup.rs"; done
mkdir -p "$cache"
# Two at once would unpack into the same folders.
exec 9>"$cache/lock"
if has flock; then flock 9; fi
# The machine's own compiler, for what runs on the machine: Debian's takes nearly twice as long.
export HOST_RUSTC=${HOST_RUSTC:-$(rustc --print sysroot)/bin/rustc}
# Not again where rustup could not, and Debian's compiler was taken.
if lacks_targets && [ ! -e "$compiler.ready" ] && has rustup; then
    say "rustup target add ${targets[*]} ..."
    rustup --quiet target add "${targets[@]}" >&2 || say "rustup cannot fetch them"
fi
path=$bin
if lacks_targets; then
    set_up_rustc
    export RUSTC=$compiler/bin/rustc
    path=$compiler/bin:$bin
fi

tools=" ${TOOLS-board} "
# lacks KIND PROGRAM: it is asked for, and neither on the machine nor in the cache.
lacks() { [[ $tools = *" $1 "* ]] && ! has "$2" && [ ! -x "$bin/$2" ]; }
if lacks board qemu-system-arm; then
    unpack qemu "qemu-system-arm: Debian's package qemu-system-arm" \
        "some 20 MB to fetch, 80 MB unpacked, some seconds" qemu-system-arm
    wrap "$bin/qemu-system-arm" "$cache/qemu/usr/lib/$debian:$cache/qemu/lib/$debian" \
        "$cache/qemu/usr/bin/qemu-system-arm" -L "$cache/qemu/usr/share/qemu"
fi
if lacks linux qemu-arm; then
    unpack qemu-user "QEMU's user mode: Debian's package qemu-user" \
        "13 MB to fetch, 100 MB unpacked, some seconds" qemu-user
    for emulator in qemu-arm qemu-riscv32 qemu-s390x; do
        wrap "$bin/$emulator" "$cache/qemu-user/usr/lib/$debian:$cache/qemu-user/lib/$debian" \
            "$cache/qemu-user/usr/bin/$emulator"
    done
fi
if lacks board defmt-print; then
    say "building defmt-print, which prints the log: a minute ..."
    # Not optimised: it has little to decode, and is sooner built.
    RUSTC=$HOST_RUSTC CARGO_PROFILE_DEV_DEBUG=false cargo install --quiet --debug --locked --root "$cache" \
        defmt-print --version '^1' >&2 ||
        fail "missing defmt-print: cargo install --locked defmt-print"
fi

exec 9>&-
export PATH=$path:$PATH
[ $# -gt 0 ] && exec "$@"
say "ready"
