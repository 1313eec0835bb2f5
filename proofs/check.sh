#!/usr/bin/env bash
# Proves every claim of this folder, two scripts at a time, and says how long each took.
#
#   proofs/check.sh            all
#   proofs/check.sh pairs ...  some of the scripts
#
# Uses Gappa and z3 as the machine has them. What is missing is installed, and said: Debian's gappa by apt-get,
# z3-solver and numpy by pip into a virtual environment in the cache folder.
set -euo pipefail
cd "$(dirname "$0")"

say() { echo "proofs: $*" >&2; }

if ! command -v gappa >/dev/null; then
    say "installing Debian's gappa, a few MB, some seconds ..."
    apt-get update >&2
    apt-get install --yes --no-install-recommends gappa >&2
fi
python=python3
if ! "$python" -c 'import z3, numpy' 2>/dev/null; then
    venv=${XDG_CACHE_HOME:-$HOME/.cache}/shutter-curve-proofs
    if [ ! -e "$venv/ready" ]; then
        say "installing z3-solver and numpy into $venv, some 50 MB to fetch, half a minute ..."
        python3 -m venv "$venv"
        "$venv/bin/pip" install --quiet z3-solver numpy >&2
        touch "$venv/ready"
    fi
    python=$venv/bin/python3
fi
export python

# The slowest first.
scripts=(rounding ticks words solve pairs cdf domain certificate octaves series guess)
[ $# -eq 0 ] || scripts=("$@")

log=$(mktemp)
trap 'rm "$log"' EXIT
status=0
# Each line is written at once, so those of two scripts do not mix.
printf '%s\n' "${scripts[@]}" |
    xargs -P 2 -I{} sh -c '"$python" {}.py || { echo "FAILED  {}"; exit 1; }' | tee "$log" || status=1
# A script that proves nothing would pass unseen.
for script in "${scripts[@]}"; do
    grep -q "s  $script: " "$log" || { echo "FAILED  $script: no claim"; status=1; }
done
if grep -q '^FAILED' "$log"; then status=1; fi
echo "proofs: $(grep -c '^proven' "$log") claims proven in $SECONDS s$([ $status = 0 ] || echo ', but not all')"
exit $status
