"""Conditions."""
from launch.condition import Condition
from periplus_launch import objects


class InvalidConditionExpressionError(Exception):
    """A text that is neither true nor false."""


class IfCondition(Condition):
    def __init__(self, predicate_expression):
        super().__init__()
        self._text = predicate_expression

    def _described(self):
        return {"condition": "if", "text": objects.text(self._text)}


class UnlessCondition(IfCondition):
    def _described(self):
        return {"condition": "unless", "text": objects.text(self._text)}


class LaunchConfigurationEquals(Condition):
    _negated = False

    def __init__(self, launch_configuration_name, expected_value):
        super().__init__()
        self._name, self._value = launch_configuration_name, expected_value

    def _described(self):
        return {
            "condition": "configuration",
            "name": str(self._name),
            "equals": objects.text(self._value),
            "is_negated": self._negated,
        }


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    _negated = True


def evaluate_condition_expression(context, expression):
    from launch.substitutions import LaunchConfiguration  # noqa: F401

    return IfCondition(list(expression)).evaluate(context)
