#!/usr/bin/env bash
# Builds the firmware with its src/leaf.rs (README.md) as it is flashed, and runs it on a model of the chip: exits with
# 0 only if each edge of the lamp's line comes on its tick. The first time it fetches the emulated processor, Python's
# unicorn, 16 MB.
#
#   .ci/thumb.sh boards/stm32f4/run.sh     or without .ci/thumb.sh, after: rustup target add thumbv7em-none-eabihf
set -euo pipefail
cd "$(dirname "$0")"

folder=$(cargo metadata --no-deps --format-version 1 | sed -n 's/.*"target_directory":"\([^"]*\)".*/\1/p')
echo "stm32f4: building the firmware ..." >&2
# Else cargo takes for this firmware what a copy of this folder has built in the same target folder.
touch src/main.rs
cargo build --quiet --locked --release
python=$folder/unicorn/bin/python
if ! "$python" -c 'import unicorn' 2>/dev/null; then
    python3 -m venv "$folder/unicorn" && "$python" -m pip install --quiet --disable-pip-version-check unicorn==2.1.4 ||
        { echo "stm32f4: no unicorn: python3 with venv (package python3-venv) and pip are needed" >&2 && exit 1; }
fi
"$python" model.py "$folder/thumbv7em-none-eabihf/release/leaf-stm32f4" "$@"
