from periplus.msgs.geographic_msgs import msg as msg

__all__ = ["msg"]
