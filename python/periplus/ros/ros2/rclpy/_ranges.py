"""Ranges of parameters."""

from __future__ import annotations

import math
from typing import Any

from rclpy.parameter import Parameter

#: Relative tolerance of the bounds and steps of floats.
REL_TOL = 1e-6


def range_problem(parameter: Parameter, descriptor: Any) -> str:
    """Reason why a value is outside the range of its descriptor, or ''."""
    if parameter.type_ is Parameter.Type.INTEGER and descriptor.integer_range:
        return _integer(parameter, descriptor.integer_range[0])
    if parameter.type_ is Parameter.Type.DOUBLE and descriptor.floating_point_range:
        return _floating(parameter, descriptor.floating_point_range[0])
    return ""


def _integer(parameter: Parameter, limits: Any) -> str:
    low, high, step, value = limits.from_value, limits.to_value, limits.step, parameter.value
    if value in (low, high):
        return ""
    if not low < value < high:
        return f"Parameter {parameter.name} out of range. Min: {low}, Max: {high}, value: {value}"
    if step and (value - low) % step:
        return (
            f"The parameter value for {parameter.name} is not a valid step. "
            f"Min: {low}, max: {high}, value: {value}, step: {step}"
        )
    return ""


def _floating(parameter: Parameter, limits: Any) -> str:
    low, high, step, value = limits.from_value, limits.to_value, limits.step, parameter.value
    if math.isclose(value, low, rel_tol=REL_TOL) or math.isclose(value, high, rel_tol=REL_TOL):
        return ""
    if not low <= value <= high:
        return f"Parameter {parameter.name} out of range Min: {low}, Max: {high}, value: {value}"
    if step:
        nearest = low + round((value - low) / step) * step
        if not math.isclose(nearest, value, rel_tol=REL_TOL):
            return (
                f"The parameter value for {parameter.name} is not close enough to a valid step. "
                f"Min: {low}, max: {high}, value: {value}, step: {step}"
            )
    return ""
