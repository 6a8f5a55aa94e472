"""Replacement of `xacro`: files are expanded by the program that evaluates the launch file."""
import os
from xml.dom import minidom

from periplus_launch import conversation


class XacroException(Exception):
    """Error of an xacro file."""


def _expanded(file, mappings):
    pairs = [[str(name), str(value)] for name, value in (mappings or {}).items()]
    file = os.fspath(file)
    if not file.startswith("package:/"):
        file = os.path.abspath(file)
    return conversation.ask("xacro", file=file, mappings=pairs)


class _Missing(minidom.Document):
    """The document of a file that cannot be expanded for want of other files. Its text is empty."""

    def __init__(self):
        super().__init__()
        self.appendChild(self.createElement("robot"))

    def toxml(self, *_words, **_options):
        return ""

    toprettyxml = toxml

    def writexml(self, *_words, **_options):
        pass


def _document(text):
    return _Missing() if text is None else minidom.parseString(text)


def process_file(input_file_name, mappings=None, **_options):
    return _document(_expanded(input_file_name, mappings))


def process(input_file_name, just_deps=False, xacro_ns=True, verbosity=1, mappings=None):
    return process_file(input_file_name, mappings=mappings).toprettyxml(indent="  ")


def parse(inp, filename=None):
    """A document that remembers its file: other files are included from there."""
    if isinstance(inp, (str, bytes)):
        document = minidom.parseString(inp)
    elif inp is None:
        document = minidom.parse(os.fspath(filename))
    else:
        document = minidom.parse(inp)
        filename = filename or getattr(inp, "name", None)
    document._xacro_file = filename
    return document


def process_doc(doc, mappings=None, **_options):
    """Expands a document in its place."""
    file = getattr(doc, "_xacro_file", None)
    is_scratch = file is None
    if is_scratch:
        file = conversation.ask("scratch", name="document.xacro", text=doc.toxml())
    made = _document(_expanded(file, mappings))
    while doc.firstChild is not None:
        doc.removeChild(doc.firstChild)
    for child in list(made.childNodes):
        doc.appendChild(doc.importNode(child, True))


def open_output(output_filename):
    import sys

    if output_filename is None:
        return sys.stdout
    folder = os.path.dirname(output_filename)
    if folder:
        os.makedirs(folder, exist_ok=True)
    return open(output_filename, "w", encoding="utf-8")
