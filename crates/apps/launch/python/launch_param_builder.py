"""Replacement of `launch_param_builder`: parameters from the files of a package."""
from pathlib import Path

from periplus_launch import conversation
import xacro
import yaml as _yaml
from ament_index_python.packages import get_package_share_path, get_package_share_directory


class ParameterBuilderFileNotFoundError(KeyError):
    """Missing file."""


ParameterValueType = object


def raise_if_file_not_found(file_path):
    """Gives the path, in the sources of its package where a build would install it from."""
    source = Path(conversation.ask("in_sources", path=str(file_path)))
    if not source.exists():
        raise ParameterBuilderFileNotFoundError(f"File {file_path} doesn't exist")
    return source


def load_file(file_path):
    if conversation.note_missing(file_path):
        return ""
    return raise_if_file_not_found(file_path).read_text(encoding="utf-8")


def load_yaml(file_path):
    return _yaml.safe_load(load_file(file_path)) or {}


def load_xacro(file_path, mappings=None):
    if conversation.note_missing(file_path):
        return ""
    return xacro.process_file(str(raise_if_file_not_found(file_path)), mappings=mappings).toxml()


def get_path(package_name, file_path):
    return str(Path(get_package_share_directory(package_name)) / file_path)


class ParameterBuilder:
    """Gathers parameters; each step gives the builder itself."""

    def __init__(self, package_name):
        self._package_path = get_package_share_path(package_name)
        self._parameters = {}

    def yaml(self, file_path, parameter_namespace=None):
        values = load_yaml(self._package_path / file_path)
        if parameter_namespace:
            self._parameters.setdefault(parameter_namespace, {}).update(values)
        else:
            self._parameters.update(values)
        return self

    def file_parameter(self, parameter_name, file_path):
        return self.parameter(parameter_name, load_file(self._package_path / file_path))

    def xacro_parameter(self, parameter_name, file_path, mappings=None):
        text = load_xacro(self._package_path / file_path, mappings=mappings)
        return self.parameter(parameter_name, text)

    def path_parameter(self, parameter_name, file_path):
        return self.parameter(parameter_name, str(self._package_path / file_path))

    def parameter(self, parameter_name, parameter_value):
        self._parameters[parameter_name] = parameter_value
        return self

    def to_dict(self):
        return self._parameters
