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

say() { echo "thumb: $*" >&2; }
fail() { say "$*"; exit 1; }

for tool in rustc cargo; do
    command -v "$tool" >/dev/null || fail "missing $tool: https://rustup.rs"
done
host=$(rustc -vV | sed -n 's/^host: //p')

has_apt() { command -v apt-get >/dev/null && command -v dpkg >/dev/null; }

# refresh HINT: Debian's lists anew, once: old ones may name an older compiler than the crate needs, or none.
refresh() {
    [ -n "${refreshed:-}" ] && return
    apt-get update >&2 || fail "apt-get update failed; missing $1"
    refreshed=yes
}

# unpack NAME HINT COST PACKAGE...: the Debian packages, unpacked into the cache folder NAME; COST is said before.
# With dependencies where NAME ends in '+': those that are not installed.
unpack() {
    local name=$1 hint=$2 cost=$3; shift 3
    local folder=$cache/${name%+}
    [ -e "$folder" ] && return
    has_apt || fail "missing $hint"
    say "fetching and unpacking Debian's $* into $cache: $cost ..."
    local work
    work=$(mktemp -d "$cache/tmp.XXXXXX")
    mkdir -p "$work/debs/partial" "$work/root"
    refresh "$hint"
    if [ "$name" != "${name%+}" ]; then
        apt-get install --yes --download-only --no-install-recommends -o Debug::NoLocking=true \
            -o Dir::Cache::archives="$work/debs" "$@" >"$work/log" 2>&1
    else
        (cd "$work/debs" && apt-get download "$@") >"$work/log" 2>&1
    fi || { cat "$work/log" >&2; fail "cannot download Debian's $*; missing $hint"; }
    local deb
    for deb in "$work"/debs/*.deb; do
        # Of the compiler's source only the library is needed, a tenth of the files.
        dpkg --fsys-tarfile "$deb" |
            tar -x -C "$work/root" --no-wildcards-match-slash --exclude './usr/src/*/src' \
                --exclude './usr/src/*/compiler' ||
            fail "cannot unpack $deb; missing $hint"
    done
    mv "$work/root" "$folder"
    rm -r "$work"
}

# depends PACKAGE PATTERN HINT: the package that PACKAGE depends on whose name has the PATTERN.
depends() {
    apt-cache depends "$1" 2>/dev/null | sed -n "s/^ *Depends: \($2\)\$/\1/p" | grep . ||
        fail "Debian's $1 is not here, or depends on no $2; missing $3"
}

# wrap COMMAND LIBRARIES PROGRAM [ARGUMENT...]: the unpacked PROGRAM as COMMAND.
wrap() {
    local command=$1 libraries=$2; shift 2
    [ -x "$1" ] || fail "the package of ${command##*/} holds no $1; remove $cache to unpack it again"
    mkdir -p "${command%/*}"
    {
        echo '#!/bin/sh'
        echo "LD_LIBRARY_PATH='$libraries' exec$(printf " '%s'" "$@") \"\$@\""
    } >"$command"
    chmod +x "$command"
}

# Debian's rustc and clippy, with a core library compiled for each target and put where rustup would put it.
set_up_rustc() {
    local hint="the targets: rustup target add ${targets[*]} (or Debian's rustc-web and rust-web-src)"
    local root=$compiler/usr
    if [ ! -e "$compiler.ready" ]; then
        has_apt || fail "missing $hint"
        local std llvm
        refresh "$hint"
        std=$(depends libstd-rust-web-dev 'libstd-rust-web-[0-9.]*' "$hint")
        llvm=$(depends "$std" 'libllvm[0-9]*' "$hint")
        rm -rf "$compiler"
        unpack compiler "$hint" "150 MB to fetch, 1.1 GB unpacked, a minute or two" \
            rustc-web rust-web-clippy libstd-rust-web-dev "$std" "$llvm" rust-web-src
        wrap "$compiler/bin/rustc" "$root/lib/$(uname -m)-linux-gnu" "$root/bin/rustc"
        wrap "$compiler/bin/cargo-clippy" "$root/lib/$(uname -m)-linux-gnu" "$root/bin/cargo-clippy"
    fi
    # The linker is rustup's, and rustup may have removed the toolchain that it was in.
    local linker=$root/lib/rustlib/$host/bin/rust-lld lld
    if [ ! -x "$linker" ]; then
        lld=$(rustc --print sysroot)/lib/rustlib/$host/bin/rust-lld
        [ -x "$lld" ] || fail "no rust-lld at $lld (rustup's toolchains have one); missing $hint"
        mkdir -p "${linker%/*}"
        ln -sfn "$lld" "$linker"
    fi
    touch "$compiler.ready"

    local work target missing=()
    for target in "${targets[@]}"; do
        # The page's target is the machine's own compiler's, if that has it.
        case $target in
        wasm*) [ ! -d "$("$HOST_RUSTC" --print target-libdir --target "$target")" ] || continue ;;
        esac
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
        mkdir -p "$work/lib"
        cp "$work/target/$target/release/deps/"lib{core,compiler_builtins}-*.r{lib,meta} "$work/lib"
        mkdir -p "$root/lib/rustlib/$target"
        mv "$work/lib" "$root/lib/rustlib/$target/lib"
    done
    rm -r "$work"
}

mkdir -p "$cache"
# Two at once would unpack into the same folders.
exec 9>"$cache/lock"
if command -v flock >/dev/null; then flock 9; fi
path=$bin
# The machine's own compiler, for what runs on the machine: Debian's takes nearly twice as long.
export HOST_RUSTC=${HOST_RUSTC:-$(rustc --print sysroot)/bin/rustc}
lacks_targets() {
    local target
    for target in "${targets[@]}"; do
        [ -d "$(rustc --print target-libdir --target "$target")" ] || return 0
    done
    return 1
}
# Not again where it could not, and Debian's compiler was taken.
if lacks_targets && [ ! -e "$compiler.ready" ] && command -v rustup >/dev/null; then
    say "rustup target add ${targets[*]} ..."
    rustup --quiet target add "${targets[@]}" >&2 || say "rustup cannot fetch them"
fi
if lacks_targets; then
    set_up_rustc
    export RUSTC=$compiler/bin/rustc
    path=$compiler/bin:$bin
fi

tools=" ${TOOLS-board} "
if [[ $tools = *" board "* ]] && ! command -v qemu-system-arm >/dev/null && [ ! -x "$bin/qemu-system-arm" ]; then
    unpack qemu+ "qemu-system-arm: Debian's package qemu-system-arm" \
        "some 20 MB to fetch, 80 MB unpacked, some seconds" qemu-system-arm
    wrap "$bin/qemu-system-arm" "$cache/qemu/usr/lib/$(uname -m)-linux-gnu:$cache/qemu/lib/$(uname -m)-linux-gnu" \
        "$cache/qemu/usr/bin/qemu-system-arm" -L "$cache/qemu/usr/share/qemu"
fi

if [[ $tools = *" linux "* ]] && ! command -v qemu-arm >/dev/null && [ ! -x "$bin/qemu-arm" ]; then
    unpack qemu-user+ "QEMU's user mode: Debian's package qemu-user" \
        "13 MB to fetch, 100 MB unpacked, some seconds" qemu-user
    for emulator in arm riscv32 s390x; do
        wrap "$bin/qemu-$emulator" \
            "$cache/qemu-user/usr/lib/$(uname -m)-linux-gnu:$cache/qemu-user/lib/$(uname -m)-linux-gnu" \
            "$cache/qemu-user/usr/bin/qemu-$emulator"
    done
fi

if [[ $tools = *" board "* ]] && ! command -v defmt-print >/dev/null && [ ! -x "$bin/defmt-print" ]; then
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
