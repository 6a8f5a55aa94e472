from periplus.msgs.unique_identifier_msgs import msg as msg

__all__ = ["msg"]
