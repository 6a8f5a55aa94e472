"""Substitutions of ROS."""
from launch.substitutions import _Of
from periplus_launch import conversation
from periplus_launch.objects import text


class FindPackageShare(_Of):
    def __init__(self, package):
        super().__init__("package", name=text(package), is_prefix=False)

    def find(self, package_name):
        return conversation.ask("package", name=package_name, is_prefix=False)


class FindPackagePrefix(_Of):
    def __init__(self, package):
        super().__init__("package", name=text(package), is_prefix=True)

    def find(self, package_name):
        return conversation.ask("package", name=package_name, is_prefix=True)


FindPackage = FindPackageShare


class ExecutableInPackage(_Of):
    def __init__(self, executable, package):
        super().__init__(
            "executable_in_package", package=text(package), executable=text(executable)
        )


class Parameter(_Of):
    def __init__(self, name, *, default=None):
        super().__init__("parameter", name=text(name))
