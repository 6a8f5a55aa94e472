"""The base of actions."""
from launch import LaunchDescriptionEntity
from periplus_launch import objects


class Action(LaunchDescriptionEntity):
    """Something that a launch file does. A subclass of a launch file's own has `execute`."""

    def __init__(self, *, condition=None):
        self._condition = condition
        self._written = objects.written()

    @property
    def condition(self):
        return self._condition

    def _described(self):
        described = {
            "id": objects.keep(self),
            "place": getattr(self, "_written", None),
            **self._deed(),
        }
        condition = getattr(self, "_condition", None)
        if condition is not None:
            from launch.condition import described as condition_described

            described["condition"] = condition_described(condition)
        return described

    def _deed(self):
        # An action of the launch file's own: it is run when its turn comes.
        return {"do": "call", "function": objects.keep(_Run(self.execute))}

    def execute(self, context):
        return None

    def visit(self, context):
        return [self]

    def describe(self):
        return type(self).__name__


class _Run:
    def __init__(self, function):
        self.function = function

    def __call__(self, context):
        return self.function(context)
