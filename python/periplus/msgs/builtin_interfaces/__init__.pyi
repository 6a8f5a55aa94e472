from periplus.msgs.builtin_interfaces import msg as msg

__all__ = ["msg"]
