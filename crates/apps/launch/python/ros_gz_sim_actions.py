"""Actions that include the launch files of `ros_gz_sim`."""
from launch.actions import IncludeLaunchDescription
from launch_ros.substitutions import FindPackageShare


class _OfFile(IncludeLaunchDescription):
    """A launch file of a package, by arguments."""

    def __init__(self, package, file, arguments, **others):
        given = [(name, value) for name, value in arguments.items() if value not in (None, "")]
        source = [FindPackageShare(package), f"/launch/{file}"]
        super().__init__(source, launch_arguments=given, condition=others.get("condition"))


class GzServer(_OfFile):
    """Runs a simulation."""

    def __init__(self, *, world_sdf_file="", world_sdf_string="", container_name="ros_gz_container",
                 create_own_container="False", use_composition="False", **others):
        arguments = {
            "world_sdf_file": world_sdf_file,
            "world_sdf_string": world_sdf_string,
            "container_name": container_name,
            "create_own_container": create_own_container,
            "use_composition": use_composition,
        }
        for unknown in sorted(others.keys() - {"condition"}):
            arguments[unknown] = others[unknown]
        super().__init__("ros_gz_sim", "gz_server.launch.py", arguments, **others)


class GzSpawnModel(_OfFile):
    """Puts a model into a world."""

    def __init__(self, **others):
        arguments = {name: value for name, value in others.items() if name != "condition"}
        super().__init__("ros_gz_sim", "gz_spawn_model.launch.py", arguments, **others)
