#!/usr/bin/env python3
"""Looks after the links of what is packed: README.md and the documents beside it, docs/.

    .ci/links.py              each relative link must lead to a file of this repository, its #part to a heading
    .ci/links.py --set URL    the repository is at URL: Cargo.toml says so, and links to what is not packed become
                              absolute

A package holds its documents, but none of the other packages: from there, links to boards, benches or examples have
no base until there is a repository. Once Cargo.toml names one, a relative link to what is not packed is an error.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MANIFEST = ROOT / "Cargo.toml"
REPOSITORY = re.compile(r'^repository = "(.*)"\n', re.M)
# [text](target) and ![text](target), not in code; a target has no blank.
LINK = re.compile(r"(?<=\])\(([^()\s]+)\)")
PICTURES = {".png", ".svg"}
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.M | re.S)


def packed():
    listing = ["cargo", "package", "--package", "shutter-curve", "--list", "--allow-dirty"]
    return set(subprocess.run(listing, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split())


def anchors(text):
    """The parts of a document that can be linked, as GitHub names them."""
    headings = re.findall(r"^#+ (.*)$", CODE.sub(lambda m: m[0] if m[0][:3] != "```" else "", text), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.replace("`", "")).strip().lower().replace(" ", "-") for heading in headings}


def links(document, text):
    """Each relative link: where its target stands in the text, and the file of this repository that it means."""
    hidden = CODE.sub(lambda m: " " * len(m[0]), text)
    for link in LINK.finditer(hidden):
        target, _, part = link[1].partition("#")
        if "://" in target or target.startswith("mailto:"):
            continue
        file = (document.parent / target).resolve() if target else document
        yield link, file, part


def check(repository, files):
    wrong, outside = [], 0
    for name in sorted(name for name in files if name.endswith(".md")):
        document = ROOT / name
        for link, file, part in links(document, document.read_text()):
            path = file.relative_to(ROOT).as_posix()
            if not file.exists():
                wrong.append(f"{name}: {link[1]} leads nowhere")
            elif part and file.suffix == ".md" and part not in anchors(file.read_text()):
                wrong.append(f"{name}: {link[1]}: no such heading")
            elif path not in files:
                outside += 1
                if repository:
                    wrong.append(f"{name}: {link[1]} is not packed; .ci/links.py --set {repository} makes it absolute")
    for line in wrong:
        print(line)
    if outside and not repository:
        print(f"{outside} links lead to what is not packed; .ci/links.py --set URL gives them a base")
    return 1 if wrong else 0


def settle(url, files):
    text = REPOSITORY.sub("", MANIFEST.read_text())
    MANIFEST.write_text(text.replace("readme = ", f'repository = "{url}"\nreadme = ', 1))
    for name in sorted(name for name in files if name.endswith(".md")):
        document = ROOT / name
        text = document.read_text()
        for link, file, part in reversed(list(links(document, text))):
            path = file.relative_to(ROOT).as_posix()
            if file.exists() and path not in files:
                kind = "tree" if file.is_dir() else "raw" if file.suffix in PICTURES else "blob"
                absolute = f"{url}/{kind}/main/{path}" + (f"#{part}" if part else "")
                text = text[: link.start(1)] + absolute + text[link.end(1) :]
        document.write_text(text)


def main():
    files = packed()
    if len(sys.argv) == 3 and sys.argv[1] == "--set":
        settle(sys.argv[2].rstrip("/"), files)
    elif len(sys.argv) != 1:
        sys.exit(__doc__)
    found = REPOSITORY.search(MANIFEST.read_text())
    sys.exit(check(found and found[1], files))


main()
