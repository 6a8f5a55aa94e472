"""Expands many xacro files in one process with PyPI xacro and prints one JSON line a file.

Input (stdin), one JSON object a line: {"file": PATH, "args": {NAME: VALUE, ...}}; "args" may lack.
Output, one JSON object a line, in the order of the input:
  {"file", "ok", "error", "kind", "xml", "find": {PACKAGE: PATH or null}}
  ok     true where xacro expanded the file within 10 s
  error  null, or "ExceptionName: text"; xacro's own stack of files and macros is not in it
  kind   null | "xacro" | "xml" | "timeout" | "other": the class of the error
  xml    the canonical form (below), null where not ok
  find   what $(find PACKAGE) gave, so that a difference can be traced to the search

Options: --bench prints only {"files", "ok", "seconds"}; --expand-to DIR also writes each expanded
document, as xacro itself would print it, to DIR/<path with "/" as "__">.urdf for urdf_oracle and
sdf_oracle, and names it in the field "expanded".

Canonical form
==============
A string, made from the DOM by these rules; two documents are equal where the strings are.
 1. Comments, processing instructions, the XML declaration and the doctype are dropped.
 2. Neighbouring text and CDATA sections, once what lay between them is dropped, are one text.
 3. Text is stripped at both ends of the XML white space characters (space, tab, CR, LF). Text that
    is then empty is dropped. White space inside a text stays as it is.
 4. An element is written `<name a="v" b="w">children</name>`, never `<name/>`; nothing is put
    between elements, no line end at the end.
 5. Names are the qualified names as written (`xacro:foo`, `xmlns:xacro`); prefixes are not
    resolved. Attributes, namespace declarations too, are sorted by the qualified name as Unicode
    code points. Attribute values are as the parser gave them (entities expanded, each literal tab
    or line end made a space), else unchanged.
 6. Namespace declarations stay where xacro leaves them: it removes `xmlns:xacro` from every
    element it visits and copies the others of an included root to the element of the include.
 7. In text `&` `<` `>` become `&amp;` `&lt;` `&gt;`; in values also `"` becomes `&quot;`, tab,
    LF and CR become `&#9;` `&#10;` `&#13;`. Everything else is itself, in UTF-8.
Numbers are compared as written: xacro prints Python's str() of them, and so must we.

$(find PACKAGE)
===============
A stub of ament_index_python answers. First DIR/PACKAGE for each DIR of the colon list
PERIPLUS_ORACLE_PATH, if it is a folder. Then, for the file being expanded (the one named on stdin,
not the included one), each folder D from its own upward to the root of its repository (the folder right
below PERIPLUS_ORACLE_ROOT), the first that exists of:
  D itself, if D/package.xml names PACKAGE, or D is called PACKAGE and has a package.xml;
  D/PACKAGE, if it is a folder;
  the first folder, in sorted order of paths, at most 3 levels below D, with a package.xml that
  names PACKAGE.
Then, over the folders R below PERIPLUS_ORACLE_ROOT in sorted order: R itself if it is called
PACKAGE, and the three rules above with D = R. Without PERIPLUS_ORACLE_ROOT the way upward ends
at "/". A miss raises, as ament_index_python does.
"""

import argparse
import json
import os
import re
import signal
import sys
import time
import types
import xml.dom.minidom
import xml.parsers.expat
from functools import lru_cache
from xml.dom import Node

SECONDS_PER_FILE = 10
XML_SPACE = " \t\r\n"
PACKAGE_NAME = re.compile(r"<name>\s*([^<\s]+)\s*</name>")


class Timeout(BaseException):
    """Not an Exception: xacro must not swallow it."""


# ---------------------------------------------------------------- the canonical form

def escape_text(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def escape_value(value):
    value = escape_text(value).replace('"', "&quot;")
    return value.replace("\t", "&#9;").replace("\n", "&#10;").replace("\r", "&#13;")


def canonical(document):
    """The canonical form of a DOM document; the module's docstring defines it."""
    out = []
    write_element(document.documentElement, out)
    return "".join(out)


def write_element(element, out):
    attributes = sorted(element.attributes.items())
    out.append("<" + element.tagName)
    out.extend(f' {name}="{escape_value(value)}"' for name, value in attributes)
    out.append(">")
    text = []
    for child in element.childNodes:
        if child.nodeType in (Node.TEXT_NODE, Node.CDATA_SECTION_NODE):
            text.append(child.data)
        elif child.nodeType == Node.ELEMENT_NODE:
            flush_text(text, out)
            write_element(child, out)
    flush_text(text, out)
    out.append(f"</{element.tagName}>")


def flush_text(text, out):
    out.append(escape_text("".join(text).strip(XML_SPACE)))
    text.clear()


# ---------------------------------------------------------------- $(find)

def corpus_root():
    root = os.environ.get("PERIPLUS_ORACLE_ROOT")
    return os.path.abspath(root) if root else None


@lru_cache(maxsize=None)
def package_named_in(folder):
    """The <name> of folder/package.xml; "" for one without; None where there is no such file."""
    try:
        with open(os.path.join(folder, "package.xml"), encoding="utf-8", errors="replace") as f:
            match = PACKAGE_NAME.search(f.read())
    except OSError:
        return None
    return match.group(1) if match else ""


@lru_cache(maxsize=None)
def packages_below(folder):
    """{package: path} of the package.xml files at most three levels below, first path wins."""
    found = {}
    for path, names, _files in os.walk(folder):
        depth = os.path.relpath(path, folder).count(os.sep) + 1 if path != folder else 0
        names[:] = sorted(n for n in names if not n.startswith(".")) if depth < 3 else []
        name = package_named_in(path)
        if depth and name:
            found.setdefault(name, []).append(path)
    return {name: min(paths) for name, paths in found.items()}


def package_at(folder, package):
    name = package_named_in(folder)
    if name is not None and package in (name, os.path.basename(folder)):
        return folder
    if os.path.isdir(os.path.join(folder, package)):
        return os.path.join(folder, package)
    return packages_below(folder).get(package)


@lru_cache(maxsize=None)
def find_package(start, package):
    for folder in filter(None, os.environ.get("PERIPLUS_ORACLE_PATH", "").split(":")):
        if os.path.isdir(os.path.join(folder, package)):
            return os.path.join(folder, package)
    root = corpus_root()
    folder = start
    while folder not in (root, os.path.dirname(folder)):
        found = package_at(folder, package)
        if found:
            return found
        folder = os.path.dirname(folder)
    for repository in sorted(os.listdir(root)) if root else []:
        folder = os.path.join(root, repository)
        if os.path.isdir(folder):
            found = folder if repository == package else package_at(folder, package)
            if found:
                return found
    return None


class Search:
    """Answers $(find) for the file at hand and remembers the answers."""

    def __init__(self):
        self.start = "/"
        self.answers = {}

    def begin(self, file):
        self.start = os.path.dirname(os.path.abspath(file))
        self.answers = {}

    def get_package_share_directory(self, package, print_warning=True):
        found = find_package(self.start, package)
        self.answers[package] = found
        if found is None:
            raise PackageNotFoundError(package)
        return found


class PackageNotFoundError(KeyError):
    def __str__(self):
        return f"package {self.args[0]!r} not found"


SEARCH = Search()


def install_stub():
    """Puts the search where xacro looks for ROS: it imports ament_index_python.packages."""
    package = types.ModuleType("ament_index_python")
    module = types.ModuleType("ament_index_python.packages")
    module.get_package_share_directory = SEARCH.get_package_share_directory
    module.PackageNotFoundError = PackageNotFoundError
    package.packages = module
    package.get_package_share_directory = SEARCH.get_package_share_directory
    sys.modules["ament_index_python"] = package
    sys.modules["ament_index_python.packages"] = module


# ---------------------------------------------------------------- one file

def on_alarm(_signal, _frame):
    raise Timeout()


def class_of(error):
    import xacro
    if isinstance(error, Timeout):
        return "timeout"
    if isinstance(error, xml.parsers.expat.ExpatError):
        return "xml"
    if isinstance(error, (xacro.XacroException, xacro.substitution_args.SubstitutionException)):
        return "xacro"
    return "other"


def expand(file, args):
    """(document, None), or (None, the exception)."""
    import xacro
    SEARCH.begin(file)
    signal.alarm(SECONDS_PER_FILE)
    try:
        return xacro.process_file(file, mappings=dict(args)), None
    except (Exception, Timeout, SystemExit, RecursionError) as error:  # noqa: BLE001
        return None, error
    finally:
        signal.alarm(0)


def jobs():
    for line in sys.stdin:
        if line.strip():
            job = json.loads(line)
            yield os.path.abspath(job["file"]), job.get("args") or {}


def main():
    parser = argparse.ArgumentParser(description="xacro oracle; see the module's docstring")
    parser.add_argument("--bench", action="store_true")
    parser.add_argument("--expand-to", metavar="DIR")
    options = parser.parse_args()
    install_stub()
    signal.signal(signal.SIGALRM, on_alarm)
    os.chdir("/")  # no relative path may be found by luck
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # xacro prints warnings; expressions may print
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    import xacro  # noqa: F401  the import is no part of the measured time

    if options.bench:
        work = list(jobs())
        start = time.perf_counter()
        good = 0
        for file, args in work:
            document, _error = expand(file, args)
            if document is not None:
                document.toprettyxml(indent="  ")
                good += 1
        seconds = time.perf_counter() - start
        print(json.dumps({"files": len(work), "ok": good, "seconds": seconds}), file=answers)
        return

    for file, args in jobs():
        document, error = expand(file, args)
        answer = {
            "file": file,
            "ok": document is not None,
            "error": None if error is None else f"{type(error).__name__}: {error}",
            "kind": None if error is None else class_of(error),
            "xml": None if document is None else canonical(document),
            "find": SEARCH.answers,
        }
        if args:
            answer["args"] = args
        if document is not None and options.expand_to:
            os.makedirs(options.expand_to, exist_ok=True)
            name = file.lstrip("/").replace("/", "__") + ".urdf"
            answer["expanded"] = os.path.join(options.expand_to, name)
            with open(answer["expanded"], "w", encoding="utf-8") as out:
                out.write(document.toprettyxml(indent="  ", encoding=None))
        print(json.dumps(answer, ensure_ascii=False), file=answers, flush=True)


if __name__ == "__main__":
    main()
