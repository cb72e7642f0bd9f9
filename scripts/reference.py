#!/usr/bin/env python3
"""reference.py FOLDER OUT [DEPFILE]: writes the reference of the public interface, one Markdown page, from the headers of FOLDER
(include/lambent). A comment is above the declaration that it documents, or behind it on the same line. A comment above functions or enumerators
documents all of them up to an empty line or the next comment; a comment above a field documents that field. Text
indented by two or more spaces within a comment (formulas, tables, code) keeps its lines."""
import os
import re
import sys
from dataclasses import dataclass, field


@dataclass
class Item:
    kind: str  # "function", "struct", "enum", "callback", "opaque", "macro", "field", "enumerator"
    name: str
    text: str  # the declaration, without comments
    doc: list = field(default_factory=list)  # lines of its comment
    behind: str = ""  # the part of the comment that stands on the declaration's own line
    members: list = field(default_factory=list)


@dataclass
class Header:
    name: str  # "camera.h"
    doc: list
    items: list


BEHIND_MOST = 60  # letters of a comment on the line of its declaration

SKIPPED = re.compile(r'#if|#else|#endif|#include|#define LAM_API|#define LAMBENT_|extern "C"|}$|struct \w+;')


def split_line(line):
    """Splits a line into its code and its comment; the comment is None if there is none."""
    code, mark, comment = line.partition("//")
    return code.rstrip(), comment.removeprefix(" ").rstrip() if mark else None


def names_of(declaration):
    """The names that a field's declaration declares: "lam_vec3 eye, target" gives eye and target."""
    pointer = re.match(r".*?\(\*(\w+)\)\s*\(", declaration)
    if pointer:
        return [pointer.group(1)]
    return [re.search(r"(\w+)\s*(\[[^]]*\]\s*)*$", part).group(1) for part in declaration.split(",")]


def members_of(lines, kind):
    """The fields of a struct or the enumerators of an enum."""
    members, above, fresh, waiting = [], [], False, ""
    for line in lines:
        code, comment = split_line(line.strip())
        if not code:
            above = (above + [comment] if fresh else [comment]) if comment is not None else []
            fresh = comment is not None
            continue
        near, fresh = fresh, False
        if code.startswith("LAM_RESERVED("):  # reserved for later fields
            continue
        waiting = (waiting + " " + code).strip()
        if kind == "struct" and not waiting.endswith(";") or kind == "enum" and waiting.count("(") > waiting.count(")"):
            continue
        doc = (above if near or not comment else []) + ([comment] if comment else [])
        if kind == "struct":
            text = waiting.rstrip(";").strip()
            members += [Item("field", name, text, doc, comment or "") for name in names_of(text)]
            above = []
        else:
            for text in filter(None, (part.strip() for part in waiting.split(","))):
                name = text.split("=")[0].strip()
                number = ["The number of those above."] if name.endswith("_COUNT") else []
                members.append(Item("enumerator", name, text, doc if comment else number or doc, comment or ""))
        waiting = ""
    return members


def declared(text, doc, behind, body):
    """Returns the item for a whole declaration at the top level of a header."""
    flat = re.sub(r"\s+", " ", text)
    compound = re.match(r"(?:typedef )?(struct|enum)(?: (\w+))? \{", flat)
    if compound:
        kind = compound.group(1)
        return Item(kind, compound.group(2) or "", "", doc, members=members_of(body, kind))
    if flat.startswith("LAM_API"):
        flat = flat.removeprefix("LAM_API ")
        return Item("function", re.search(r"(\w+)\(", flat).group(1), flat, doc, behind)
    if flat.startswith("typedef struct"):
        return Item("opaque", flat.rstrip(";").split()[-1], flat, doc, behind)
    if flat.startswith("typedef"):
        name = re.search(r"\(\*(\w+)\)\(", flat) or re.search(r"(\w+)\(", flat) or re.search(r"(\w+);$", flat)
        return Item("callback", name.group(1), flat, doc, behind)
    raise ValueError("not understood: " + flat)


def parse(path):
    lines = open(path, encoding="utf-8").read().split("\n")
    header = Header(os.path.basename(path), [], [])
    at, above, group = 0, [], []
    while at < len(lines):
        line = lines[at]
        at += 1
        if line.startswith("//"):
            above.append(split_line(line)[1])
            continue
        if not header.doc and above and line.startswith("#ifndef"):
            header.doc, above = above, []
            continue
        macro = re.match(r"#define (LAM_\w+)(?: +([^/]*))?", line)
        if not line.strip() or SKIPPED.match(line) and not (macro and macro.group(1) != "LAM_API"):
            above, group = [], []
            continue
        doc, above = above or group, []
        if macro:
            code, comment = split_line(line)
            header.items.append(Item("macro", macro.group(1), re.sub(r" +", " ", code), doc + ([comment] if comment else [])))
            group = doc
            continue
        code, comment = split_line(line)
        text, behind, body = code, [comment] if comment else [], []
        compound = re.match(r"(typedef )?(struct|enum)( \w+)? \{", text)
        while not re.search(r";$", text) or compound and not re.match(r"}|.*}[^{]*;$", lines[at - 1]):
            code, comment = split_line(lines[at])
            if compound and not lines[at].startswith("}"):
                body.append(lines[at])
            elif comment:
                behind.append(comment)
            text += "\n" + code
            at += 1
        if compound and not body:  # on one line
            body = [re.sub(r"^[^{]*\{|\}[^}]*$", "", text)]
        item = declared(text, doc + behind, " ".join(behind), body)
        header.items.append(item)
        group = doc if item.kind in ("function", "callback") else []
    return header


def headers(folder):
    names = sorted(n for n in os.listdir(folder) if n.endswith(".h") and n != "lambent.h")
    return [parse(os.path.join(folder, n)) for n in ["base.h"] + [n for n in names if n != "base.h"]]


# --- the page


def paragraphs(doc, link):
    """Converts a comment's lines to Markdown; indented lines become a code block."""
    out = [["", ""]]
    for line in doc:
        kind = "code" if line.startswith("  ") else "text" if line else ""
        if kind != out[-1][0]:
            out.append([kind, ""])
        out[-1][1] += "    " + line + "\n" if kind == "code" else line + " "
    return "\n".join(text if kind == "code" else link(text.strip()) + "\n" for kind, text in out if text.strip())


def cell(text):
    return text.replace("|", "\\|")


def member_rows(item, link):
    head = "| field | type | |" if item.kind == "struct" else "| value | |"
    yield head + "\n" + re.sub(r"[^|]+", "---", head)
    for member in item.members:
        doc = cell(link(" ".join(line.strip() for line in member.doc)))
        anchor = '<a id="%s"></a>`%s`' % (anchor_of(item, member), member.name)
        if item.kind == "enum":
            number = member.text.partition("=")[2].strip()
            yield "| %s%s | %s |" % (anchor, " = `%s`" % cell(number) if number else "", doc)
        else:
            yield "| %s | `%s` | %s |" % (anchor, cell(type_of(member)), doc)


def type_of(member):
    """The type of a field: of "lam_vec3 eye, *target[2]" for target "lam_vec3 *[2]"."""
    if "(*" in member.text:
        return re.sub(r"\(\*\w+\)", "(*)", member.text)
    first, *others = member.text.split(",")
    base, name = re.match(r"(.*?)(\**\w+\s*(?:\[[^]]*\]\s*)*)$", first).groups()
    own = next(part.strip() for part in [name] + others if re.search(r"\b%s\b" % member.name, part))
    return (base.strip() + " " + own.replace(member.name, "", 1)).strip()


def anchor_of(item, member=None):
    return item.name if not member else member.name if item.kind == "enum" else item.name + "." + member.name


def write(all_headers, out):
    known = {anchor_of(i) for h in all_headers for i in h.items if i.name}
    known |= {anchor_of(i, m) for h in all_headers for i in h.items for m in i.members}

    def word(match):
        name = match.group().strip("`")
        return "[`%s`](#%s)" % (name, name) if name in known else match.group()

    def link(text):
        """Turns names into links and escapes Markdown characters, outside of `code`."""
        text = re.sub(r"`[^`]*`|[<*_]", lambda m: m.group() if m.group()[0] == "`" else "\\" + m.group(), text)
        return re.sub(r"`[^`]*`|\b(?:lam|LAM)(?:\\_[A-Za-z0-9]+)+(?:\.\w+(?:\\_\w+)*)?",
                      lambda m: word(re.match(".*", m.group().replace("\\", ""))), text)

    out.append("# The interface of the library\n")
    out.append("Generated from the headers of `include/lambent`. `#include <lambent/lambent.h>` includes them all.\n")
    for header in all_headers:
        title, _, rest = header.doc[0].partition(": ")
        out.append("- [%s](#%s): %s" % (header.name, header.name, link(" ".join([rest] + header.doc[1:]).split(". ")[0])))
    out.append("- [Index](#index)")
    for header in all_headers:
        out.append('\n## <a id="%s"></a>%s\n' % (header.name, header.name))
        start = header.doc[0].partition(": ")[2]
        out.append(paragraphs([start[:1].upper() + start[1:]] + header.doc[1:], link))
        before = None
        for item in header.items:
            together = before and item.doc == before.doc and item.kind == before.kind and item.kind in ("function", "macro")
            if not together:
                out.append("\n### %s\n" % (item.name and "`%s`" % item.name or "Constants"))
            if item.name:
                out.append('<a id="%s"></a>\n' % item.name)
            if item.text:
                out.append("```c\n%s\n```\n" % item.text)
            if not together:
                out.append(paragraphs(item.doc, link))
            if item.members:
                out.append("\n".join(member_rows(item, link)) + "\n")
            before = item
    out.append('\n## <a id="index"></a>Index\n')
    for anchor in sorted(known, key=str.lower):
        out.append("- [`%s`](#%s)" % (anchor, anchor))


def complaints(all_headers):
    """Problems of the headers' documentation: undocumented declarations, and comments behind code that are too long."""
    for header in all_headers:
        for item in header.items:
            where = "%s: %s" % (header.name, item.name or "enum")
            if not item.doc and item.kind != "macro" and item.name:
                yield where + " is not documented"
            lines = {member.text for member in item.members}
            for member in item.members:
                if not member.doc and not (len(lines) == 1 and item.doc):
                    yield "%s.%s is not documented" % (where, member.name)
            for part in [item] + item.members:
                if len(part.behind) > BEHIND_MOST:
                    yield "%s %s: the comment behind it is longer than %d letters: it belongs above" % (where, part.name, BEHIND_MOST)


def main():
    out = []
    write(headers(sys.argv[1]), out)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write("\n".join(out) + "\n")
    if len(sys.argv) > 3:
        with open(sys.argv[3], "w", encoding="utf-8") as file:
            names = sorted(n for n in os.listdir(sys.argv[1]) if n.endswith(".h"))
            file.write("%s: %s\n" % (sys.argv[2], " ".join(os.path.join(sys.argv[1], n) for n in names)))


if __name__ == "__main__":
    main()
