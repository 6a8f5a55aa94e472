from periplus.msgs.vision_msgs import msg as msg

__all__ = ["msg"]
