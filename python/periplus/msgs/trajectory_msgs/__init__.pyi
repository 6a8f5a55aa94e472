from periplus.msgs.trajectory_msgs import msg as msg

__all__ = ["msg"]
