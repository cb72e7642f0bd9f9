"""binding.py: builds the module lambent._native with cffi (API mode, stable ABI). Its declarations are read from the public headers."""
import pathlib
import re

import cffi

ROOT = pathlib.Path(__file__).resolve().parent.parent
HEADERS = ROOT / "include" / "lambent"


def header_names(name="lambent.h", seen=None):
    """The headers that a header includes, each before those that need it."""
    seen = {} if seen is None else seen
    for inner in re.findall(r'#include ["<](?:lambent/)?(\w+\.h)[">]', (HEADERS / name).read_text()):
        if (HEADERS / inner).exists() and inner not in seen:
            seen.update(dict.fromkeys(header_names(inner, seen)))
            seen[inner] = None
    return list(seen)


def declarations():
    """The public headers in a form that cffi can read: without comments, directives and attributes. Constants get the value that the compiler
    computes."""
    text = ""
    for name in header_names():
        code = re.sub(r"//[^\n]*", "", (HEADERS / name).read_text())
        text += "".join("#define %s ...\n" % constant for constant in re.findall(r"#define (LAM_\w+) +[0-9]", code))
        code = re.sub(r"(?m)^#.*(\\\n.*)*\n", "", code)
        code = re.sub(r'extern "C" \{\n(?=\n)|^\}\n', "", code, flags=re.M)
        text += re.sub(r"LAM_RESERVED\((\d+)\)", r"uint64_t reserved[\1]", code.replace("LAM_API ", ""))
    return text


def library_hash():
    """The declaration of the hash function of the program's journals and reports, from its header."""
    return re.search(r"^uint64_t xxh64_of\(.*\);", (ROOT / "tools/base/xxh64.h").read_text(), re.M)[0]


builder = cffi.FFI()
builder.cdef(declarations() + library_hash() + '\nextern "Python" void tell_progress(void *user, double share, const char *step);')
builder.set_source("lambent._native", "#include <lambent/lambent.h>\n#include <xxh64.c>\n", include_dirs=[str(HEADERS.parent), str(ROOT / "tools/base")])
