"""Evaluates launch files for the program that started it.

Requests come as lines of JSON on the standard input, answers leave on what was the standard output.
What a launch file prints goes to the standard error. The first line brings the modules that stand in
for those of ROS while a file is evaluated, and the limit of memory.
"""
import importlib
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

    def __init__(self, sources, wanted):
        self.sources, self.wanted = sources, wanted

    def find_spec(self, name, path=None, target=None):
        if not self.wanted(name.partition(".")[0]):
            return None
        if name not in self.sources and submodules.provider(name) is None:
            return None
        return importlib.util.spec_from_loader(
            name,
            self,
            origin=f"<{name}>",
            is_package=submodules.is_package(name, self.sources),
        )

    def exec_module(self, module):
        name = module.__spec__.name
        if name not in self.sources:
            same_as(module, submodules.provider(name))
            return
        execute(self.sources[name], name, module.__dict__)


def execute(text, name, names):
    file = f"<{name}>"
    # So that a traceback shows the line.
    linecache.cache[file] = (len(text), None, text.splitlines(True), file)
    exec(compile(text, file, "exec"), names)


def same_as(module, provider):
    """Gives a module the names of another, which may still be on its way."""
    other = importlib.import_module(provider)

    def forward(name):
        if name.startswith("__") or not hasattr(other, name):
            raise AttributeError(f"module {module.__name__!r} has no attribute {name!r}")
        return getattr(other, name)

    module.__getattr__ = forward
    module.__all__ = [name for name in vars(other) if not name.startswith("_")]


class Workspace(importlib.abc.MetaPathFinder):
    """Finds the Python modules of packages that are not installed."""

    def find_spec(self, name, path=None, target=None):
        if path is not None or "." in name:
            return None
        from periplus_launch import conversation

        folder = conversation.module_folder(name)
        if not folder:
            return None
        return importlib.machinery.PathFinder.find_spec(name, [folder])


class _Needed(type):
    """A class of which nothing can be used."""

    def __call__(cls, *_args, **_options):
        module = cls.__module__
        raise ModuleNotFoundError(
            f"`{cls.__name__}` needs `{module}`, which is not on this machine", name=module
        )

    def __getattr__(cls, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return cls()


def _refuse(name):
    def refuse(cls, *_args, **_options):
        return _Needed.__call__(cls)

    setattr(_Needed, name, refuse)


# A value of the module would be in the plan, or would decide something.
for _name in """
    str format bool eq ne lt le gt ge len iter getitem setitem contains int float index fspath
    add radd sub rsub mul rmul truediv rtruediv floordiv rfloordiv mod rmod pow rpow neg pos abs
    and rand or ror xor rxor enter
""".split():
    _refuse(f"__{_name}__")
_Needed.__hash__ = type.__hash__


class Absent(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Modules that are not on this machine. A launch file may import one that its plan does not need, as
    tests beside a launch file do; using it says that it is missing."""

    def __init__(self):
        self.known = set()

    def find_spec(self, name, path=None, target=None):
        if not submodules.is_absent(name) and not self.is_import_of_user(name):
            return None
        self.known.add(name)
        return importlib.util.spec_from_loader(name, self, is_package=True)

    def is_import_of_user(self, name):
        """Returns true if a module is imported by a line of a launch file, or of a module of its workspace, that
        is not prepared for its absence."""
        from periplus_launch import objects

        parent = name.rpartition(".")[0]
        if parent and parent not in self.known:
            # A part of a module that is there is missing.
            return False
        frame = sys._getframe(1)
        while frame is not None and frame.f_code.co_filename.startswith("<"):
            frame = frame.f_back
        if frame is None or not objects.is_own(frame.f_code.co_filename):
            return False
        caught = {"ImportError", "ModuleNotFoundError", "Exception", "BaseException"}
        return not objects.is_caught(frame.f_code.co_filename, frame.f_lineno, caught)

    def exec_module(self, module):
        def make(name):
            if name.startswith("__"):
                raise AttributeError(name)
            return _Needed(name, (), {"__module__": module.__name__})

        module.__getattr__ = make
        if module.__name__ == "rclpy.logging":
            import logging

            module.get_logger = logging.getLogger


def limit_memory(most):
    """Bounds what this process may take, on systems that can."""
    try:
        import resource

        resource.setrlimit(resource.RLIMIT_DATA, (most, most))
    except (ImportError, OSError, ValueError):
        pass


def main():
    first = json.loads(lines_in.readline())
    sources = first["modules"]
    limit_memory(first["most_memory"])
    global submodules
    submodules = importlib.util.module_from_spec(
        importlib.util.spec_from_loader("periplus_submodules", loader=None)
    )
    execute(sources["periplus_launch.submodules"], "periplus_launch.submodules", vars(submodules))
    # The working folder of the program is not a module path.
    sys.path[:] = [folder for folder in sys.path if folder]
    sys.dont_write_bytecode = True
    sys.meta_path.insert(0, Sources(sources, lambda top: top not in submodules.LAST))
    sys.meta_path.append(Workspace())
    sys.meta_path.append(Sources(sources, lambda top: top in submodules.LAST))
    sys.meta_path.append(Absent())
    from periplus_launch import conversation

    conversation.run(lines_in, lines_out)


main()
