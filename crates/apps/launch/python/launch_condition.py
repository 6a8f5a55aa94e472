"""The base of conditions."""
from periplus_launch import conversation, objects


class Condition:
    """Condition: a function of the context."""

    def __init__(self, *, predicate=None):
        self._predicate = predicate

    def evaluate(self, context):
        if self._predicate is not None:
            return bool(self._predicate(context))
        return conversation.ask(
            "holds", condition=described(self), context=context._snapshot()
        )

    def _predicate_func(self, context):
        return self.evaluate(context)

    def describe(self):
        return type(self).__name__

    def _described(self):
        return {"condition": "python", "id": objects.keep(self)}


def described(condition):
    if not isinstance(condition, Condition):
        raise TypeError(f"{condition!r} is not a condition")
    if objects.is_own(type(condition).evaluate.__code__.co_filename):
        return Condition._described(condition)
    return condition._described()
