"""Names that a `.cfg` file uses."""

from dynamic_reconfigure.parameter_generator import (
    ParameterGenerator,
    bool_t,
    double_t,
    int_t,
    str_t,
)

__all__ = ["ParameterGenerator", "bool_t", "double_t", "int_t", "str_t"]
