from periplus.msgs.geometry_msgs import msg as msg

__all__ = ["msg"]
