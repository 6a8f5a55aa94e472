"""Events of managed nodes."""
from launch.event import Event
from lifecycle_msgs.msg import Transition


class ChangeState(Event):
    def __init__(self, *, lifecycle_node_matcher, transition_id):
        self.lifecycle_node_matcher = lifecycle_node_matcher
        self.transition = Transition._names.get(transition_id)
        if self.transition is None:
            raise ValueError(f"{transition_id!r} is no transition of a managed node")


class StateTransition(Event):
    pass


def matches_node_name(node_name):
    return None
