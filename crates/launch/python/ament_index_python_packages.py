"""Where packages are. One that is not here has the place `package://NAME`."""
import pathlib

from periplus_launch import conversation


class PackageNotFoundError(KeyError):
    """No package of that name."""


def get_package_share_directory(package_name, print_warning=True):
    return conversation.ask("package", name=package_name, is_prefix=False)


def get_package_prefix(package_name):
    return conversation.ask("package", name=package_name, is_prefix=True)


class _Path(type(pathlib.Path())):
    """A path that keeps the `//` of `package://`."""

    def __str__(self):
        return super().__str__().replace("package:/", "package://", 1)

    __fspath__ = __str__


def get_package_share_path(package_name, print_warning=True):
    return _Path(get_package_share_directory(package_name))


def get_package_prefix_path(package_name):
    return _Path(get_package_prefix(package_name))
