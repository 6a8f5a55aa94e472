from periplus.msgs.rosgraph_msgs import msg as msg

__all__ = ["msg"]
