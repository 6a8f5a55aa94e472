from periplus.msgs.service_msgs import msg as msg

__all__ = ["msg"]
