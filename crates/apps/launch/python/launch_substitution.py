"""The base of substitutions."""
from periplus_launch import conversation, objects


class Substitution:
    """Substitution, resolved when needed. One defined in a launch file has `perform`."""

    def _described(self):
        return {"sub": "python", "id": objects.keep(self)}

    def perform(self, context):
        raise NotImplementedError(f"{type(self).__name__} has no `perform`")

    def describe(self):
        return type(self).__name__

    def __truediv__(self, other):
        from launch.substitutions import PathJoinSubstitution

        return PathJoinSubstitution([self, other])

    def __rtruediv__(self, other):
        from launch.substitutions import PathJoinSubstitution

        return PathJoinSubstitution([other, self])

    @classmethod
    def parse(cls, data):
        return cls, {}


def perform(described, context):
    """The text of a substitution that the program evaluates."""
    described = _without_own(described, context)
    return conversation.ask("perform", text=[described], context=context._snapshot())


def _without_own(described, context):
    """The same, with what only Python can evaluate done."""
    if isinstance(described, list):
        return [_without_own(each, context) for each in described]
    if not isinstance(described, dict):
        return described
    if described.get("sub") == "python":
        return str(objects.get(described["id"]).perform(context))
    return {key: _without_own(value, context) for key, value in described.items()}
