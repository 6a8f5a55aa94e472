"""Sources of included actions."""
from launch import LaunchDescriptionSource


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    def __init__(self, launch_file_path=None, **others):
        super().__init__(location=others.get("location", launch_file_path))


class AnyLaunchDescriptionSource(PythonLaunchDescriptionSource):
    pass


class FrontendLaunchDescriptionSource(PythonLaunchDescriptionSource):
    pass


class XMLLaunchDescriptionSource(PythonLaunchDescriptionSource):
    pass


class YAMLLaunchDescriptionSource(PythonLaunchDescriptionSource):
    pass


class Entity:
    """A piece of a file."""


class Parser:
    """Reads a file."""


class InvalidPythonLaunchFileError(Exception):
    """A file that has no `generate_launch_description`."""


def get_launch_description_from_any_launch_file(launch_file_path, *, parser=None):
    from launch import LaunchDescription
    from launch.actions import IncludeLaunchDescription

    source = AnyLaunchDescriptionSource(launch_file_path)
    return LaunchDescription([IncludeLaunchDescription(source)])


get_launch_description_from_python_launch_file = get_launch_description_from_any_launch_file
get_launch_description_from_frontend_launch_file = get_launch_description_from_any_launch_file


def load_python_launch_file_as_module(python_launch_file_path):
    import importlib.util

    spec = importlib.util.spec_from_file_location("launch_file", python_launch_file_path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
