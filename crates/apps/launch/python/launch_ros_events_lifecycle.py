"""Events of lifecycle nodes."""
from launch.event import Event
from lifecycle_msgs.msg import Transition


class ChangeState(Event):
    def __init__(self, *, lifecycle_node_matcher, transition_id):
        self.lifecycle_node_matcher = lifecycle_node_matcher
        self.transition = Transition._names.get(transition_id)
        if self.transition is None:
            raise ValueError(f"{transition_id!r} is not a transition of a lifecycle node")


class StateTransition(Event):
    """A lifecycle node has gone to another state."""

    def __init__(self, *, action=None, msg=None, **_others):
        self.action, self.msg = action, msg
        self.start_state = self.goal_state = self.transition = ""


class _Named:
    """Matches the node of a name."""

    action = None

    def __init__(self, node_name):
        self.node_name = node_name

    def __call__(self, action):
        return getattr(action, "node_name", None) == self.node_name


def matches_node_name(node_name):
    return _Named(node_name)


matches_node_namespace = matches_node_name
