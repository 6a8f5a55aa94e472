from periplus.msgs.std_msgs import msg as msg

__all__ = ["msg"]
