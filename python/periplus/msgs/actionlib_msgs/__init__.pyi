from periplus.msgs.actionlib_msgs import msg as msg

__all__ = ["msg"]
