"""Folders of packages. A missing package has the path `package://NAME`."""
import pathlib
import sys

from periplus_launch import conversation, objects


class PackageNotFoundError(KeyError):
    """No package of that name."""


def get_package_share_directory(package_name, print_warning=True):
    return _found(package_name, is_prefix=False)


def get_package_prefix(package_name):
    return _found(package_name, is_prefix=True)


def _found(name, is_prefix):
    # A launch file that has a way without the package is to take it.
    if _is_expected_to_miss() and name not in get_packages_with_prefixes():
        raise PackageNotFoundError(f"package '{name}' not found")
    return conversation.ask("package", name=name, is_prefix=is_prefix)


def get_packages_with_prefixes():
    return conversation.ask("packages")


class _Path(type(pathlib.Path())):
    """A path that keeps the `//` of `package://`."""

    def __str__(self):
        return super().__str__().replace("package:/", "package://", 1)

    __fspath__ = __str__


def get_package_share_path(package_name, print_warning=True):
    return _Path(get_package_share_directory(package_name))


def get_package_prefix_path(package_name):
    return _Path(get_package_prefix(package_name))


_WAYS_OUT = {"PackageNotFoundError", "KeyError", "LookupError", "Exception", "BaseException"}


def _is_expected_to_miss():
    """Returns true if the calling line of the launch file handles a missing package."""
    frame = sys._getframe(1)
    while frame is not None and not objects.is_own(frame.f_code.co_filename):
        frame = frame.f_back
    if frame is None:
        return False
    return objects.is_caught(frame.f_code.co_filename, frame.f_lineno, _WAYS_OUT)
