"""Event handlers of ROS."""
from launch.event_handler import _On


class OnStateTransition(_On):
    def __init__(self, *, entities, target_lifecycle_node=None, transition=None, start_state=None,
                 goal_state=None, matcher=None, **_others):
        super().__init__(
            "reached", entities, of=target_lifecycle_node, to=goal_state, **{"from": start_state}
        )
