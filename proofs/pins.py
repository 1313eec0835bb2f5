"""Lists the pins that differ from src/. With --write, which is for after the comparison, puts them into the scripts."""

from common import *

for path in sorted(HERE.glob("*.py")):
    text = path.read_text()
    for table in re.findall(r'pinned\("""\n(.*?)"""\)', text, re.S):
        fresh = table
        for line in table.strip().splitlines():
            file, *rest = line.split()
            for name, pin in zip(rest[::2], rest[1::2]):
                found = hash_of(file, name)
                if found != pin:
                    print(f"{path.name}: src/{file} {name} {pin} -> {found}")
                    new = line.replace(f"{name} {pin}", f"{name} {found or pin}")
                    fresh, line = fresh.replace(line, new), new
        text = text.replace(table, fresh)
    if sys.argv[1:] == ["--write"]:
        path.write_text(text)
