"""Lists the pins that differ from src/. With --write, which is for after the comparison, puts them into the scripts."""

from common import *

for path in sorted(HERE.glob("*.py")):
    text = path.read_text()
    for table in re.findall(r'pinned\("""\n(.*?)"""\)', text, re.S):
        for file, name, pin in pins(table):
            found = hash_of(file, name)
            if found != pin:
                print(f"{path.name}: src/{file} {name} {pin} -> {found}")
                text = text.replace(f" {name} {pin}", f" {name} {found or pin}")
    if sys.argv[1:] == ["--write"]:
        path.write_text(text)
