"""layout.py: the structs and constants of the public headers, parsed; header sets with older and newer structs made from them."""
import os
import re

RESERVED = re.compile(r"LAM_RESERVED\((\d+)\)")


class Field:
    def __init__(self, name, declaration, reserved=0):
        self.name, self.declaration, self.reserved = name, declaration, reserved


def strip_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)


def fields_of(body):
    """Returns one Field for each declarator of a struct's body."""
    found = []
    for part in (" ".join(part.split()) for part in body.split(";")):
        if not part:
            continue
        reserved = RESERVED.fullmatch(part)
        if reserved:
            found.append(Field("reserved", part, int(reserved.group(1))))
            continue
        pointer = re.fullmatch(r".*\(\*(\w+)\)\(.*\)", part)
        if pointer:
            found.append(Field(pointer.group(1), part))
            continue
        first = re.fullmatch(r"((?:const )?(?:struct )?\w+(?: const\b)?)(.*)", part)
        for declarator in first.group(2).split(","):
            found.append(Field(re.search(r"(\w+)(\[.*)?$", declarator.strip()).group(1), first.group(1) + " " + declarator.strip()))
    return found


STRUCT = re.compile(r"typedef struct (lam_\w+) \{(.*?)\n\} \1;", re.S)


def structs(text):
    return {m.group(1): fields_of(m.group(2)) for m in STRUCT.finditer(strip_comments(text))}


def constants(text):
    found = []
    for body in re.findall(r"enum(?: lam_\w+)? \{(.*?)\}", strip_comments(text), flags=re.S):
        found += [word.split("=")[0].strip() for word in body.split(",") if word.strip()]
    return found


def read(folder):
    """All headers in one text."""
    return "".join(open(os.path.join(folder, name)).read() for name in sorted(os.listdir(folder)) if name.endswith(".h"))


def rewrite(source, target, change):
    """Copies the headers, and replaces each struct's fields by change(name, fields)."""
    os.makedirs(target)
    for name in sorted(os.listdir(source)):
        def replaced(match):
            fields = change(match.group(1), fields_of(match.group(2)))
            body = "".join("    %s;\n" % field.declaration for field in fields)
            return "typedef struct %s {\n%s} %s;" % (match.group(1), body, match.group(1))
        text = STRUCT.sub(replaced, strip_comments(open(os.path.join(source, name)).read()))
        open(os.path.join(target, name), "w").write(text)


def layout_program(text):
    """C that prints "struct NAME SIZE", "field STRUCT NAME OFFSET SIZE" and "constant NAME NUMBER"."""
    lines = ["#include <lambent/lambent.h>", "#include <lambent/check.h>", "#include <stdio.h>", "int main(void) {"]
    for name, fields in structs(text).items():
        lines.append('printf("struct %s %%zu\\n", sizeof(%s));' % (name, name))
        for field in fields:
            lines.append('printf("field %s %s %%zu %%zu\\n", offsetof(%s, %s), sizeof(((%s *)0)->%s));' % (
                name, field.name, name, field.name, name, field.name))
    for name in constants(text):
        lines.append('printf("constant %s %%lld\\n", (long long)%s);' % (name, name))
    return "\n".join(lines + ["return 0; }", ""])


def parse_layout(text):
    """Returns Returns name → (size, {field: (offset, size)}), and constant → number."""
    sizes, numbers = {}, {}
    for words in (line.split() for line in text.splitlines() if not line.startswith("#")):
        if words[0] == "struct":
            sizes[words[1]] = (int(words[2]), {})
        elif words[0] == "field":
            sizes[words[1]][1][words[2]] = (int(words[3]), int(words[4]))
        else:
            numbers[words[1]] = int(words[2])
    return sizes, numbers


def differences(recorded, now):
    """Lists the differences that would break a program compiled with the recorded layout."""
    found = []
    for name, (size, fields) in recorded[0].items():
        if name not in now[0]:
            found.append("%s is gone" % name)
            continue
        size_now, fields_now = now[0][name]
        if size_now != size:
            found.append("%s has %d bytes, recorded %d" % (name, size_now, size))
        free_from = fields["reserved"][0] if "reserved" in fields else size
        for field, place in fields.items():
            if field != "reserved" and fields_now.get(field) != place:
                found.append("%s.%s is at %s, recorded at %s (offset, size)" % (name, field, fields_now.get(field), place))
        for field, (offset, _) in fields_now.items():
            if field not in fields and offset < free_from:
                found.append("%s.%s is new and not in place of reserved words" % (name, field))
        if "reserved" in fields_now and fields_now["reserved"][0] % 8:
            found.append("%s: the fields before the reserved words end at byte %d, expected a multiple of 8" % (
                name, fields_now["reserved"][0]))
    for name, number in recorded[1].items():
        if not name.endswith(("_COUNT", "_MAX")) and now[1].get(name) != number:
            found.append("%s is %s, recorded %d" % (name, now[1].get(name), number))
    return found
