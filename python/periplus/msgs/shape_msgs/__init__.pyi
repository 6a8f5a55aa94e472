from periplus.msgs.shape_msgs import msg as msg

__all__ = ["msg"]
