"""Parameters of a node."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rclpy._warnings import warn
from rclpy._parameter_callbacks import ParameterCallbacks
from rclpy._ranges import REL_TOL, range_problem
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from rclpy.parameter import PARAMETER_SEPARATOR_STRING, Parameter
from rclpy.validate_parameter_name import validate_parameter_name

if TYPE_CHECKING:
    from rcl_interfaces.msg import ListParametersResult, ParameterDescriptor, ParameterValue, SetParametersResult

_EMPTY_LIST = (
    "parameter list cannot be empty, this might be due to pre_set_parameters_callback modifying the original "
    "parameters list."
)
_NAME_ONLY = (
    "when declaring parameter named '{name}', declaring a parameter only providing its name is deprecated. "
    "You have to either:\n"
    '\t- Pass a name and a default value different to "PARAMETER NOT SET" (and optionally a descriptor).\n'
    "\t- Pass a name and a parameter type.\n"
    "\t- Pass a name and a descriptor with `dynamic_typing=True"
)


class NodeParameters(ParameterCallbacks):
    """The part of a node that has to do with parameters."""

    PARAM_REL_TOL = REL_TOL

    _parameters: dict[str, Parameter]
    _descriptors: dict[str, Any]
    _parameter_overrides: dict[str, Parameter]
    _allow_undeclared_parameters: bool
    _parameter_event_publisher: Any
    _rcl_full_name: str

    if TYPE_CHECKING:

        def get_clock(self) -> Any: ...

    def _rcl_init_parameters(self, overrides: dict[str, Parameter], allow_undeclared: bool) -> None:
        self._parameters = {}
        self._descriptors = {}
        self._parameter_overrides = overrides
        self._allow_undeclared_parameters = allow_undeclared
        self._rcl_init_callbacks()
        self._parameter_event_publisher = None

    # ---- declaring

    def declare_parameter(
        self,
        name: str,
        value: Any = None,
        descriptor: ParameterDescriptor | None = None,
        ignore_override: bool = False,
    ) -> Parameter:
        """Declares a parameter and returns it.

        Args:
            name: Name; dots separate parts.
            value: Default value, or a `Parameter.Type` for a parameter without one.
            descriptor: Description, ranges, read-only and dynamic typing.
            ignore_override: Ignore the values of the command line, files and the constructor (default False).

        Raises:
            ParameterAlreadyDeclaredException, InvalidParameterException, InvalidParameterTypeException,
            InvalidParameterValueException, TypeError, ValueError
        """
        entry = (name, value) if descriptor is None else (name, value, descriptor)
        if value is None and descriptor is None:
            entry = (name,)  # type: ignore[assignment]
        return self._rcl_declare("", [entry], ignore_override)[0]

    def declare_parameters(
        self, namespace: str, parameters: Sequence[Any], ignore_override: bool = False
    ) -> list[Parameter]:
        """Declares several parameters, given as tuples (name, value, descriptor), and returns them.

        `namespace` and a dot stand before the names. Value and descriptor may be left out; see `declare_parameter`.
        """
        return self._rcl_declare(namespace, parameters, ignore_override)

    def _rcl_declare(
        self, namespace: str, entries: Sequence[Any], ignore_override: bool
    ) -> list[Parameter]:
        from rcl_interfaces.msg import ParameterDescriptor

        parameters, descriptors = [], {}
        for index, entry in enumerate(entries):
            if len(entry) < 1 or len(entry) > 3:
                raise TypeError(
                    f"Invalid parameter tuple length at index {index} in parameters list: {entry}; "
                    "expecting length between 1 and 3"
                )
            name, value, descriptor = (*entry, None, None)[:3]
            if not isinstance(name, str):
                raise TypeError(f"First element {name} at index {index} in parameters list is not a str.")
            if namespace:
                name = f"{namespace}{PARAMETER_SEPARATOR_STRING}{name}"
            if descriptor is None:
                descriptor = ParameterDescriptor()
                if value is None:
                    warn(_NAME_ONLY.format(name=name))
                    descriptor.dynamic_typing = True
            elif not isinstance(descriptor, ParameterDescriptor):
                raise TypeError(
                    f"Third element {descriptor} at index {index} in parameters list is not a ParameterDescriptor."
                )
            validate_parameter_name(name)
            parameter = self._rcl_declared(name, value, descriptor, ignore_override)
            descriptor.name = name
            parameters.append(parameter)
            descriptors[name] = descriptor
        known = [parameter.name for parameter in parameters if parameter.name in self._parameters]
        if known:
            raise ParameterAlreadyDeclaredException(known)
        for parameter in parameters:
            self._rcl_store_declared(parameter, descriptors[parameter.name])
        return [self._parameters[parameter.name] for parameter in parameters]

    def _rcl_declared(self, name: str, value: Any, descriptor: Any, ignore_override: bool) -> Parameter:
        """Parameter of a declaration, with the override; sets the type of the descriptor."""
        kind: Any
        if isinstance(value, Parameter.Type):
            if value is Parameter.Type.NOT_SET:
                raise ValueError("Cannot declare parameter {" + name + "} as statically typed of type NOT_SET")
            if descriptor.dynamic_typing:
                raise ValueError(
                    f"parameter {name!r}: a type and a descriptor with dynamic_typing=True contradict each other; "
                    "pass a default value instead of the type"
                )
            kind, value = value, None
        else:
            kind = Parameter.Type.from_parameter_value(value)
            if kind is Parameter.Type.NOT_SET and not descriptor.dynamic_typing:
                raise ValueError(
                    f"parameter {name!r} needs a value or a type: pass one, or a descriptor with dynamic_typing=True"
                )
        descriptor.type = kind.value
        if not ignore_override and name in self._parameter_overrides:
            return Parameter(name, value=self._parameter_overrides[name].value)
        return Parameter(name, value=value)

    def _rcl_store_declared(self, parameter: Parameter, descriptor: Any) -> None:
        result = self._rcl_apply([parameter], {parameter.name: descriptor}, is_declaration=True)
        if result.successful:
            return
        if result.reason.startswith("Wrong parameter type"):
            raise InvalidParameterTypeException(parameter, Parameter.Type(descriptor.type))
        raise InvalidParameterValueException(parameter.name, parameter.value, result.reason)

    def undeclare_parameter(self, name: str) -> None:
        """Removes a parameter. Raises `ParameterNotDeclaredException`, `ParameterImmutableException`."""
        if name not in self._parameters:
            raise ParameterNotDeclaredException(name)
        if self._descriptors[name].read_only:
            raise ParameterImmutableException(name)
        del self._parameters[name]
        del self._descriptors[name]

    # ---- reading

    def has_parameter(self, name: str) -> bool:
        """True if the parameter is declared."""
        return name in self._parameters

    def get_parameter(self, name: str) -> Parameter:
        """A parameter. Raises `ParameterNotDeclaredException`, or `ParameterUninitializedException` without a value."""
        parameter = self._parameters.get(name)
        if parameter is None:
            if self._allow_undeclared_parameters:
                return Parameter(name)
            raise ParameterNotDeclaredException(name)
        if parameter.type_ is Parameter.Type.NOT_SET and not self._descriptors[name].dynamic_typing:
            raise ParameterUninitializedException(name)
        return parameter

    def get_parameters(self, names: list[str]) -> list[Parameter]:
        """Several parameters; raises as `get_parameter`."""
        if not all(isinstance(name, str) for name in names):
            raise TypeError("All names must be instances of type str")
        return [self.get_parameter(name) for name in names]

    def get_parameter_or(self, name: str, alternative_value: Parameter | None = None) -> Parameter:
        """A parameter, or the alternative (default: a parameter without a value) if it is not declared or not set."""
        parameter = self._parameters.get(name)
        if parameter is None or parameter.type_ is Parameter.Type.NOT_SET:
            return Parameter(name) if alternative_value is None else alternative_value
        return parameter

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter]:
        """Parameters whose names begin with a prefix and a dot, by the rest of their names."""
        if prefix:
            prefix += PARAMETER_SEPARATOR_STRING
        return {
            name[len(prefix) :]: parameter for name, parameter in self._parameters.items() if name.startswith(prefix)
        }

    def get_parameter_type(self, name: str) -> Any:
        """Number of the type of a parameter. Raises `ParameterNotDeclaredException`."""
        if name in self._parameters:
            return self._parameters[name].type_.value
        if self._allow_undeclared_parameters:
            return Parameter.Type.NOT_SET
        raise ParameterNotDeclaredException(name)

    def get_parameter_types(self, names: list[str]) -> list[Any]:
        """Numbers of the types of several parameters."""
        if not all(isinstance(name, str) for name in names):
            raise TypeError("All names must be instances of type str")
        return [self.get_parameter_type(name) for name in names]

    def list_parameters(self, prefixes: list[str], depth: int) -> ListParametersResult:
        """Names of the parameters under any of the prefixes (none: of all), at most `depth` parts deep (0: no limit)."""
        from rcl_interfaces.msg import ListParametersResult

        if not isinstance(prefixes, list):
            raise TypeError("The prefixes argument must be a list")
        if not all(isinstance(prefix, str) for prefix in prefixes):
            raise TypeError("All prefixes must be instances of type str")
        if not isinstance(depth, int):
            raise TypeError("The depth must be instance of type int")
        if depth < 0:
            raise ValueError("The depth must be greater than or equal to zero")

        def is_wanted(name: str) -> bool:
            if not prefixes:
                return depth == 0 or name.count(".") < depth
            for prefix in prefixes:
                if name == prefix:
                    return True
                inside = name.startswith(prefix + ".")
                if inside and (depth == 0 or name[len(prefix) + 1 :].count(".") < depth):
                    return True
            return False

        names = [name for name in self._parameters if is_wanted(name)]
        found = dict.fromkeys(name.rpartition(".")[0] for name in names if "." in name)
        return ListParametersResult(names=names, prefixes=list(found))

    # ---- setting

    def set_parameters(self, parameter_list: list[Parameter]) -> list[SetParametersResult]:
        """Sets parameters one after another, and returns one result for each.

        Raises `ParameterNotDeclaredException` for one that is not declared; those before it are set.
        """
        parameters = self._rcl_checked(parameter_list)
        return [self._rcl_set([parameter]) for parameter in parameters]

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """Sets all parameters or none, and returns the result. Raises `ParameterNotDeclaredException`."""
        return self._rcl_set(self._rcl_checked(parameter_list))

    @staticmethod
    def _rcl_checked(parameter_list: list[Parameter]) -> list[Parameter]:
        parameters = list(parameter_list)
        for parameter in parameters:
            if not isinstance(parameter, Parameter):
                raise TypeError(f"parameter must be instance of type '{Parameter!r}'")
        return parameters

    def _rcl_set(self, parameters: list[Parameter]) -> SetParametersResult:
        for callback in self._pre_set_parameters_callbacks:
            parameters = callback(parameters)
        if not parameters:
            from rcl_interfaces.msg import SetParametersResult

            return SetParametersResult(successful=False, reason=_EMPTY_LIST)
        if not self._allow_undeclared_parameters:
            undeclared = [parameter.name for parameter in parameters if parameter.name not in self._parameters]
            if undeclared:
                # Programs see the text: the first name is not part of it.
                raise ParameterNotDeclaredException(undeclared[1:])
        return self._rcl_apply(parameters, {}, is_declaration=False)

    def _rcl_apply(
        self, parameters: list[Parameter], descriptors: dict[str, Any], is_declaration: bool
    ) -> SetParametersResult:
        """Checks parameters against descriptors and callbacks, and stores them."""
        from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult

        for parameter in parameters:
            descriptor = descriptors.get(parameter.name, self._descriptors.get(parameter.name))
            if descriptor is None:
                descriptor = ParameterDescriptor(name=parameter.name, dynamic_typing=True)
            descriptors[parameter.name] = descriptor
            reason = self._rcl_problem(parameter, descriptor, is_declaration)
            if reason:
                return SetParametersResult(successful=False, reason=reason)
        for callback in self._on_set_parameters_callbacks:
            result = callback(parameters)
            if not isinstance(result, SetParametersResult):
                warn("Callback returned an invalid type, it should return SetParameterResult.")
                return SetParametersResult(successful=False, reason="Callback returned an invalid type")
            if not result.successful:
                return result
        self._rcl_store(parameters, descriptors, is_declaration)
        for post in self._post_set_parameters_callbacks:
            post(parameters)
        return SetParametersResult(successful=True)

    @staticmethod
    def _rcl_problem(parameter: Parameter, descriptor: Any, is_declaration: bool) -> str:
        if descriptor.read_only and not is_declaration:
            return f"Trying to set a read-only parameter: {parameter.name}."
        if parameter.type_ is Parameter.Type.NOT_SET:
            if not is_declaration and not descriptor.dynamic_typing:
                return "Static parameter cannot be undeclared"
            return ""
        if not descriptor.dynamic_typing and descriptor.type != parameter.type_.value:
            return f"Wrong parameter type, expected '{Parameter.Type(descriptor.type)}' got '{parameter.type_}'"
        return range_problem(parameter, descriptor)

    def _rcl_store(self, parameters: list[Parameter], descriptors: dict[str, Any], is_declaration: bool) -> None:
        from rcl_interfaces.msg import ParameterEvent

        event = ParameterEvent() if self._parameter_event_publisher is not None else None
        for parameter in parameters:
            name = parameter.name
            known = self._parameters.get(name)
            if parameter.type_ is Parameter.Type.NOT_SET and not is_declaration:
                if known is not None:
                    del self._parameters[name], self._descriptors[name]
                    if event is not None:
                        event.deleted_parameters.append(Parameter(name).to_parameter_msg())
                continue
            descriptor = descriptors[name]
            if descriptor.dynamic_typing:
                descriptor.type = parameter.type_.value
            self._descriptors[name] = descriptor
            self._parameters[name] = parameter
            if event is not None and parameter.type_ is not Parameter.Type.NOT_SET:
                is_new = known is None or known.type_ is Parameter.Type.NOT_SET
                where = event.new_parameters if is_new else event.changed_parameters
                where.append(parameter.to_parameter_msg())
        if event is not None:
            event.node = self._rcl_full_name
            event.stamp = self.get_clock().now().to_msg()
            self._parameter_event_publisher.publish(event)

    # ---- descriptors

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """Descriptor of a parameter. Raises `ParameterNotDeclaredException`."""
        if name in self._descriptors:
            return self._descriptors[name]
        if self._allow_undeclared_parameters:
            from rcl_interfaces.msg import ParameterDescriptor

            return ParameterDescriptor()
        raise ParameterNotDeclaredException(name)

    def describe_parameters(self, names: list[str]) -> list[ParameterDescriptor]:
        """Descriptors of several parameters."""
        return [self.describe_parameter(name) for name in names]

    def set_descriptor(
        self, name: str, descriptor: ParameterDescriptor, alternative_value: ParameterValue | None = None
    ) -> ParameterValue:
        """Replaces the descriptor of a parameter, and returns the value.

        Raises `ParameterNotDeclaredException`, `ParameterImmutableException`, or `InvalidParameterValueException` if
        the value (or the alternative, which is set if given) does not fit.
        """
        parameter = self.get_parameter(name)
        if self._descriptors[name].read_only:
            raise ParameterImmutableException(name)
        if alternative_value is not None:
            from rclpy.parameter import parameter_value_to_python

            parameter = Parameter(name, value=parameter_value_to_python(alternative_value))
        descriptor.name = name
        reason = self._rcl_problem(parameter, descriptor, True)
        if reason:
            raise InvalidParameterValueException(name, parameter.value, reason)
        self._descriptors[name] = descriptor
        if alternative_value is not None:
            result = self._rcl_apply([parameter], {name: descriptor}, is_declaration=True)
            if not result.successful:
                raise InvalidParameterValueException(name, parameter.value, result.reason)
        return self.get_parameter(name).get_parameter_value()
