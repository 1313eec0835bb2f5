#!/usr/bin/env bash
# Proves every claim of this folder, two scripts at a time, and says how long each took: `proofs/check.sh` all of them,
# `proofs/check.sh words ...` some. If Python has no z3, z3-solver is installed into a virtual environment in the cache
# folder, and that is said.
set -euo pipefail
cd "$(dirname "$0")"

python=python3
if ! "$python" -c 'import z3' 2>/dev/null; then
    venv=${XDG_CACHE_HOME:-$HOME/.cache}/shutter-curve-proofs
    if [ ! -e "$venv/ready" ]; then
        echo "proofs: installing z3-solver into $venv, some 30 MB to fetch, half a minute ..." >&2
        python3 -m venv "$venv"
        "$venv/bin/pip" install --quiet z3-solver >&2
        touch "$venv/ready"
    fi
    python=$venv/bin/python3
fi
export python

# The slowest first.
scripts=(ticks words domain octaves search certificate)
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
! grep -q '^FAILED' "$log" || status=1
echo "proofs: $(grep -c '^proven' "$log") claims proven in $SECONDS s$([ $status = 0 ] || echo ', but not all')"
exit $status
