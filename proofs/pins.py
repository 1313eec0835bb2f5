"""Lists the pins that differ from src/. With --write, which is for after the comparison, puts them into the scripts."""

from common import *

for path in sorted(HERE.glob("*.py")):
    text = path.read_text()
    for table in re.findall(r'pinned\("""\n(.*?)"""\)', text, re.S):
        fresh = []
        for line in table.splitlines():
            file, *rest = line.split()
            for i in range(0, len(rest), 2):
                found = hash_of(file, rest[i])
                if found != rest[i + 1]:
                    print(f"{path.name}: src/{file} {rest[i]} {rest[i + 1]} -> {found}")
                    rest[i + 1] = found or rest[i + 1]
            fresh.append(" ".join([file, *rest]) + "\n")
        text = text.replace(table, "".join(fresh))
    if sys.argv[1:] == ["--write"]:
        path.write_text(text)
