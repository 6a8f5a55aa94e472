"""Evaluates launch files for the program that started it.

Requests come as lines of JSON on the standard input, answers leave on what was the standard output.
What a launch file prints goes to the standard error. The first line brings the modules that stand in
for those of ROS while a file is evaluated.
"""
import importlib.abc
import importlib.util
import json
import linecache
import os
import sys

lines_in = sys.stdin
lines_out = os.fdopen(os.dup(1), "w", encoding="utf-8")
os.dup2(2, 1)


class Sources(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds modules among texts that were handed over."""

    def __init__(self, sources):
        self.sources = sources

    def find_spec(self, name, path=None, target=None):
        if name not in self.sources:
            return None
        is_package = any(other.startswith(name + ".") for other in self.sources)
        return importlib.util.spec_from_loader(
            name, self, origin=f"<{name}>", is_package=is_package
        )

    def exec_module(self, module):
        name = module.__spec__.name
        text = self.sources[name]
        file = f"<{name}>"
        # So that a traceback shows the line.
        linecache.cache[file] = (len(text), None, text.splitlines(True), file)
        exec(compile(text, file, "exec"), module.__dict__)


def main():
    sources = json.loads(lines_in.readline())
    sys.meta_path.insert(0, Sources(sources))
    from periplus_launch import conversation

    conversation.run(lines_in, lines_out)


main()
