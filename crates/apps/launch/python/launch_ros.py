"""Replacement of `launch_ros`, while a launch file is evaluated."""
from . import (  # noqa: F401
    actions,
    descriptions,
    event_handlers,
    events,
    parameter_descriptions,
    substitutions,
    utilities,
)

ParametersType = RemapRulesType = SomeParameters = SomeRemapRules = object
