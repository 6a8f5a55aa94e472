from periplus.msgs.nav_2d_msgs import msg as msg

__all__ = ["msg"]
