"""The base of actions."""
from launch import LaunchDescriptionEntity
from periplus_launch import objects


class Action(LaunchDescriptionEntity):
    """Launch action. A subclass defined in a launch file has `execute`."""

    def __init__(self, *, condition=None):
        self._condition = condition
        self._written = objects.written()

    @property
    def condition(self):
        return self._condition

    def _described(self):
        is_own = objects.is_own(type(self).execute.__code__.co_filename)
        described = {
            "id": objects.keep(self),
            "place": getattr(self, "_written", None),
            **(Action._deed(self) if is_own else self._deed()),
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
        """What the class of a launch file's own gets that extends one of these."""
        if type(self)._deed is Action._deed:
            return None
        return [_Deed(self)]

    @staticmethod
    def parse(entity, parser):
        return Action, {}


class _Run:
    def __init__(self, function):
        self.function = function

    def __call__(self, context):
        return self.function(context)


class _Deed(Action):
    """What an action does by itself, without what its class in the launch file adds."""

    def __init__(self, action):
        super().__init__()
        self._action = action
        self._written = getattr(action, "_written", None)

    def _deed(self):
        return self._action._deed()
