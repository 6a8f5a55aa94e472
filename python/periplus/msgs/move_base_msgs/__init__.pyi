from periplus.msgs.move_base_msgs import msg as msg

__all__ = ["msg"]
