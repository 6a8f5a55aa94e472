"""Where included actions come from."""
from launch import LaunchDescriptionSource


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    def __init__(self, launch_file_path):
        super().__init__(location=launch_file_path)


class AnyLaunchDescriptionSource(PythonLaunchDescriptionSource):
    pass


class FrontendLaunchDescriptionSource(PythonLaunchDescriptionSource):
    pass


class XMLLaunchDescriptionSource(PythonLaunchDescriptionSource):
    pass


class YAMLLaunchDescriptionSource(PythonLaunchDescriptionSource):
    pass
