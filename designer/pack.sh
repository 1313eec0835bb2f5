#!/usr/bin/env bash
# pack.sh FILES FOLDER: makes of the page's files a folder for any static host, under any path.
#
# All files but those that a browser asks for by a fixed name stand in a folder that is called by their content: what an old
# index.html names is never a new file, however long a host lets browsers keep either.
set -euo pipefail
from=$1 to=$2
sum() { if command -v sha256sum >/dev/null; then sha256sum; else shasum -a 256; fi; }

rm -rf "$to.new"
mkdir "$to.new"
version=$(cd "$from" && cat $(LC_ALL=C ls) | sum | cut -c 1-12)
mkdir "$to.new/$version"
cp "$from"/* "$to.new/$version"
for file in index.html sw.js; do
    mv "$to.new/$version/$file" "$to.new"
    sed -i.bak "s|@version@|$version|g" "$to.new/$file"
done
# What is kept for when there is no network.
files=$(cd "$to.new/$version" && printf "'%s', " *)
sed -i.bak "s|^const FILES = \[\]|const FILES = [${files%, }]|" "$to.new/sw.js"
rm "$to.new"/*.bak
rm -rf "$to"
mv "$to.new" "$to"
