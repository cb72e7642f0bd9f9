#!/usr/bin/env python3
"""symbols.py BUILD [--check]: writes the symbols files of the Debian packages (packaging/debian/*.symbols) from the shared libraries of a build folder.
New symbols get the present version, and removed symbols are deleted. With --check it writes nothing, and exits with code 1 if there is a difference."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIBRARIES = {"liblambent0": "liblambent.so", "liblambent-check0": "liblambent-check.so"}


def exported(library):
    """The symbols with their versions, as dpkg-gensymbols writes them: "lam_draw@LAMBENT_0"."""
    text = subprocess.run(["nm", "-D", "--defined-only", "--format=posix", library], stdout=subprocess.PIPE, text=True, check=True).stdout
    # In "lam_draw@@LAMBENT_0 T ...", LAMBENT_0 is the version; "LAMBENT_0 A" is the version symbol
    # itself.
    names = [line.split()[0].replace("@@", "@") for line in text.splitlines()]
    return sorted(name if "@" in name else name + "@" + name for name in names)


def main():
    build = pathlib.Path(sys.argv[1])
    version = re.search(r"^  version: '(.*)',", (ROOT / "meson.build").read_text(), re.M)[1]
    differs = False
    for package, library in LIBRARIES.items():
        path = ROOT / "packaging" / "debian" / (package + ".symbols")
        text = path.read_text()
        since = dict(re.findall(r"^ (\S+) (\S+)$", text, re.M))
        found = next(build.glob("**/" + library))
        rows = "".join(" %s %s\n" % (name, since.get(name, version)) for name in exported(found))
        wanted = text[:text.index("\n ") + 1] + rows
        if wanted != text and "--check" in sys.argv:
            names = set(exported(found)) ^ set(since)
            print("%s: differs from %s: %s" % (path.relative_to(ROOT), library, ", ".join(sorted(names)) or "order"))
        elif wanted != text:
            path.write_text(wanted)
        differs |= wanted != text
    sys.exit(differs and "--check" in sys.argv)


if __name__ == "__main__":
    main()
